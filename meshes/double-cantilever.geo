// Double cantilever with its crack along the x axis (not meshed), finer where it grows; a line of nodes ends the grips at the left.
// Lengths in metres.
DefineConstant[ fine = 3.5e-4 ];     // mesh size where the crack grows
DefineConstant[ coarse = 2e-3 ];     // largest mesh size
DefineConstant[ growth = 0.2 ];      // by how much the size grows with the distance from there
DefineConstant[ length = 50e-3 ];    // along x
DefineConstant[ half_height = 10e-3 ];
DefineConstant[ grip = 1e-3 ];       // length of the grips
DefineConstant[ from = 4e-3 ];       // the fine part, along x
DefineConstant[ to = 22e-3 ];
DefineConstant[ band = 1e-3 ];       // half-height of the fine part
DefineConstant[ algorithm = 5 ];     // 5: Delaunay, 6: Frontal-Delaunay

// No node lies on the crack at the left: half a size above and below it.
gap = 0.5 * fine;
Point(1) = {0, -half_height, 0};
Point(2) = {grip, -half_height, 0};
Point(3) = {length, -half_height, 0};
Point(4) = {length, half_height, 0};
Point(5) = {grip, half_height, 0};
Point(6) = {0, half_height, 0};
Point(7) = {0, gap, 0};
Point(8) = {0, -gap, 0};
Point(9) = {grip, gap, 0};
Point(10) = {grip, -gap, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Line(9) = {5, 9};
Line(10) = {9, 10};
Line(11) = {10, 2};
Transfinite Curve{7, 10} = 2;
Curve Loop(1) = {1, -11, -10, -9, 5, 6, 7, 8};
Curve Loop(2) = {2, 3, 4, 9, 10, 11};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

Physical Point("corner", 1) = {3};
Physical Surface("beam", 2) = {1, 2};

middle = 0.5 * (from + to);
half = 0.5 * (to - from);
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Sqrt(Max(Abs(x - %g) - %g, 0)^2 + Max(Abs(y) - %g, 0)^2)", fine, growth, middle, half, band);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
