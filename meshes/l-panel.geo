// L-shaped panel: a square, one corner at the origin, without its lower right quarter. Lengths in metres.
DefineConstant[ size = 0.02 ];       // mesh size
DefineConstant[ side = 0.5 ];        // of the square
DefineConstant[ arm = 0.03 ];        // from the free end of the arm to the load at its lower edge
DefineConstant[ algorithm = 6 ];      // 5: Delaunay, 6: Frontal-Delaunay

h = side / 2;
Point(1) = {0, 0, 0};
Point(2) = {h, 0, 0};
Point(3) = {h, h, 0};                // the inner corner
Point(4) = {side - arm, h, 0};       // the load
Point(5) = {side, h, 0};
Point(6) = {side, side, 0};
Point(7) = {0, side, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};
Plane Surface(1) = {1};

Physical Point("load", 1) = {4};
Physical Curve("foot", 2) = {1};
Physical Surface("panel", 3) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g", size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
