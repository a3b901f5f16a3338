// Single-edge-notched beam of Schlangen in four-point shear: a beam about the origin of x with a notch from above, meshed as a void.
// Lengths in metres.
DefineConstant[ fine = 0.003 ];      // mesh size where the crack runs
DefineConstant[ coarse = 0.008 ];    // largest mesh size
DefineConstant[ half_length = 0.22 ];
DefineConstant[ height = 0.1 ];
DefineConstant[ depth = 0.02 ];      // of the notch
DefineConstant[ width = 0.005 ];     // of the notch
DefineConstant[ outer = 0.2 ];       // distance of the outer plates from the middle
DefineConstant[ inner = 0.02 ];      // distance of the inner plates from the middle
DefineConstant[ plate = 0.02 ];      // width of a plate

half = plate / 2;
Point(1) = {-half_length, 0, 0};
Point(2) = {-inner - half, 0, 0};
Point(3) = {-inner + half, 0, 0};
Point(4) = {outer - half, 0, 0};
Point(5) = {outer + half, 0, 0};
Point(6) = {half_length, 0, 0};
Point(7) = {half_length, height, 0};
Point(8) = {inner + half, height, 0};
Point(9) = {inner - half, height, 0};
Point(10) = {width / 2, height, 0};
Point(11) = {width / 2, height - depth, 0};
Point(12) = {-width / 2, height - depth, 0};
Point(13) = {-width / 2, height, 0};
Point(14) = {-outer + half, height, 0};
Point(15) = {-outer - half, height, 0};
Point(16) = {-half_length, height, 0};
For i In {1:15}
  Line(i) = {i, i + 1};
EndFor
Line(16) = {16, 1};
Curve Loop(1) = {1:16};
Plane Surface(1) = {1};

Physical Curve("support-inner", 1) = {2};
Physical Curve("support-outer", 2) = {4};
Physical Curve("load-inner", 3) = {8};
Physical Curve("load-outer", 4) = {14};
Physical Surface("beam", 5) = {1};

Field[1] = Box;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[1].XMin = -0.035;
Field[1].XMax = 0.045;
Field[1].YMin = 0;
Field[1].YMax = height;
Field[1].Thickness = 0.025;
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 5;
Mesh.MshFileVersion = 4.1;
