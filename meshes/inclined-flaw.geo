// Plate centred at the origin, fine around a flaw through its middle and the cracks that grow from it; the flaw is not meshed.
// Lengths in metres.
DefineConstant[ fine = 0.001 ];      // mesh size around the flaw
DefineConstant[ coarse = 0.005 ];    // largest mesh size
DefineConstant[ half_width = 0.04 ];
DefineConstant[ half_height = 0.05 ];

Point(1) = {-half_width, -half_height, 0};
Point(2) = {half_width, -half_height, 0};
Point(3) = {half_width, half_height, 0};
Point(4) = {-half_width, half_height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Physical Curve("bottom", 1) = {1};
Physical Curve("right", 2) = {2};
Physical Curve("top", 3) = {3};
Physical Curve("left", 4) = {4};
Physical Surface("plate", 5) = {1};

Field[1] = Box;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[1].XMin = -0.013;
Field[1].XMax = 0.013;
Field[1].YMin = -0.02;
Field[1].YMax = 0.02;
Field[1].Thickness = 0.025;
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 5;
Mesh.MshFileVersion = 4.1;
