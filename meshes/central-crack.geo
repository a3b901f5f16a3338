// Plate under tension along y with room for a crack on the x axis in the middle; finer along
// that axis. The crack is not meshed.
// Lengths in metres.
DefineConstant[ fine = 0.001 ];      // mesh size along the x axis
DefineConstant[ coarse = 0.004 ];    // largest mesh size
DefineConstant[ half_width = 0.05 ];
DefineConstant[ half_height = 0.1 ];
DefineConstant[ band = 0.005 ];      // half-height of the fine strip along the crack
DefineConstant[ growth = 0.15 ];     // by how much the size grows with the distance from the strip

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
Physical Curve("top", 2) = {3};
Physical Surface("plate", 3) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Max(Fabs(y) - %g, 0)", fine, growth, band);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 5;                  // Delaunay: spacings that vary, as a study of non-unified horizons wants
Mesh.MshFileVersion = 4.1;
