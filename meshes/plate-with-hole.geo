// Plate centred at the origin with a round hole, finer at the hole. Lengths in metres.
DefineConstant[ fine = 0.001 ];      // mesh size at the hole
DefineConstant[ coarse = 0.008 ];    // largest mesh size
DefineConstant[ growth = 0.1 ];      // by how much the size grows with the distance from the hole
DefineConstant[ radius = 0.005 ];    // of the hole
DefineConstant[ half_width = 0.05 ]; // along x
DefineConstant[ half_height = 0.1 ]; // along y, the load
DefineConstant[ algorithm = 5 ];     // 5: Delaunay; 6: frontal

Point(1) = {0, 0, 0};
Point(2) = {radius, 0, 0};
Point(3) = {0, radius, 0};
Point(4) = {-radius, 0, 0};
Point(5) = {0, -radius, 0};
Point(6) = {-half_width, -half_height, 0};
Point(7) = {half_width, -half_height, 0};
Point(8) = {half_width, half_height, 0};
Point(9) = {-half_width, half_height, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 9};
Line(8) = {9, 6};
Curve Loop(1) = {5:8};
Curve Loop(2) = {1:4};
Plane Surface(1) = {1, 2};

Physical Curve("bottom", 1) = {5};
Physical Curve("top", 2) = {7};
Physical Curve("hole", 3) = {1:4};
Physical Surface("plate", 4) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * (Sqrt(x*x + y*y) - %g)", fine, growth, radius);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
