// Double-edge-notched plate of Nooru-Mohamed: a square with two notches at half its height, meshed as voids.
// Lengths in metres.
DefineConstant[ fine = 0.004 ];      // mesh size where cracks run
DefineConstant[ coarse = 0.008 ];    // largest mesh size
DefineConstant[ side = 0.2 ];
DefineConstant[ depth = 0.025 ];     // of a notch
DefineConstant[ width = 0.005 ];     // of a notch
DefineConstant[ band = 0.055 ];      // half-height of the fine strip
DefineConstant[ algorithm = 5 ];      // 5: Delaunay, 6: Frontal-Delaunay

below = (side - width) / 2;
above = (side + width) / 2;
Point(1) = {0, 0, 0};
Point(2) = {side, 0, 0};
Point(3) = {side, below, 0};
Point(4) = {side - depth, below, 0};
Point(5) = {side - depth, above, 0};
Point(6) = {side, above, 0};
Point(7) = {side, side, 0};
Point(8) = {0, side, 0};
Point(9) = {0, above, 0};
Point(10) = {depth, above, 0};
Point(11) = {depth, below, 0};
Point(12) = {0, below, 0};
For i In {1:11}
  Line(i) = {i, i + 1};
EndFor
Line(12) = {12, 1};
Curve Loop(1) = {1:12};
Plane Surface(1) = {1};

Physical Curve("bottom", 1) = {1};
Physical Curve("lower-right", 2) = {2};
Physical Curve("top", 3) = {7};
Physical Curve("upper-left", 4) = {8};
Physical Surface("plate", 5) = {1};

Field[1] = Box;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[1].XMin = 0;
Field[1].XMax = side;
Field[1].YMin = side / 2 - band;
Field[1].YMax = side / 2 + band;
Field[1].Thickness = 0.03;
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
