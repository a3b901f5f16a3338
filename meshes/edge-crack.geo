// Plate for a crack from its left side along the x axis, finer where the crack begins to grow. The crack is not meshed.
// Lengths in metres.
DefineConstant[ fine = 0.005 ];      // mesh size where the crack begins to grow
DefineConstant[ coarse = 0.04 ];     // largest mesh size
DefineConstant[ growth = 0.2 ];      // by how much the size grows with the distance from there
DefineConstant[ width = 0.4 ];       // along x
DefineConstant[ half_height = 0.4 ]; // along y
DefineConstant[ from = 0.14 ];       // the fine part, along x
DefineConstant[ to = 0.22 ];
DefineConstant[ band = 0.02 ];       // half-height of the fine part
DefineConstant[ mouth = 0.03 ];      // half-height of the middle of the left side, which carries no load

Point(1) = {0, -half_height, 0};
Point(2) = {width, -half_height, 0};
Point(3) = {width, half_height, 0};
Point(4) = {0, half_height, 0};
Point(5) = {0, mouth, 0};
Point(6) = {0, -mouth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

Physical Point("lower-right", 1) = {2};
Physical Point("upper-right", 2) = {3};
Physical Curve("bottom", 3) = {1};
Physical Curve("top", 4) = {3};
Physical Curve("upper-left", 5) = {4};
Physical Curve("lower-left", 6) = {6};
Physical Surface("plate", 7) = {1};

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
Mesh.Algorithm = 5;                  // Delaunay
Mesh.MshFileVersion = 4.1;
