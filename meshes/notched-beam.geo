// Beam for three-point bending, its lower edge on the x axis and the middle of the span at x = 0; finer around the middle. The notch
// is not meshed. Lengths in metres.
DefineConstant[ fine = 0.01 ];       // mesh size around the middle
DefineConstant[ coarse = 0.025 ];    // largest mesh size
DefineConstant[ growth = 0.2 ];      // by how much the size grows with the distance from the band
DefineConstant[ band = 0.06 ];       // half-width of the fine band
DefineConstant[ half_span = 1.0 ];
DefineConstant[ depth = 0.2 ];
DefineConstant[ algorithm = 6 ];      // 5: Delaunay, 6: Frontal-Delaunay

Point(1) = {-half_span, 0, 0};
Point(2) = {half_span, 0, 0};
Point(3) = {half_span, depth, 0};
Point(4) = {0, depth, 0};
Point(5) = {-half_span, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};

Physical Point("left", 1) = {1};
Physical Point("right", 2) = {2};
Physical Point("load", 3) = {4};
Physical Surface("beam", 4) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Max(Fabs(x) - %g, 0)", fine, growth, band);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
