// Square plate loaded at two opposite corners: the loading diagonal stands along the y axis.
// The slot is not meshed. Lengths in metres.
DefineConstant[ size = 0.003 ];      // mesh size
DefineConstant[ fine = 0.0015 ];     // mesh size at the left, x < refine
DefineConstant[ refine = -0.03 ];    // where the two sizes meet
DefineConstant[ side = 0.15 ];       // side of the square
DefineConstant[ patch = 0.02 ];      // depth of a loading patch below its corner

d = side / Sqrt(2);
c = d - patch;

Point(1) = {0, -d, 0};
Point(2) = {patch, -c, 0};
Point(3) = {d, 0, 0};
Point(4) = {patch, c, 0};
Point(5) = {0, d, 0};
Point(6) = {-patch, c, 0};
Point(7) = {-d, 0, 0};
Point(8) = {-patch, -c, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Line(9) = {8, 2};
Line(10) = {4, 6};
Curve Loop(1) = {1, -9, 8};
Curve Loop(2) = {2, 3, 10, 6, 7, 9};
Curve Loop(3) = {4, 5, -10};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};

Physical Surface("plate", 1) = {1, 2, 3};
Physical Surface("patch-top", 2) = {3};
Physical Surface("patch-bottom", 3) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * 0.5 * (1 + tanh((x - (%g)) / 0.006))", fine, size - fine, refine);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6;                  // Frontal-Delaunay
Mesh.MshFileVersion = 4.1;
