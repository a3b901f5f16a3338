// Plate for a crack from its left side along the x axis (not meshed), finer above that axis. Lengths in metres.
DefineConstant[ fine = 0.002 ];      // mesh size above the axis
DefineConstant[ coarse = 0.004 ];    // largest mesh size below it
DefineConstant[ growth = 0 ];        // above 0: below the axis the size grows by this times the distance, up to the largest
DefineConstant[ width = 0.09 ];
DefineConstant[ half_height = 0.03 ];
DefineConstant[ algorithm = 5 ];     // 5: Delaunay; 6: frontal

Point(1) = {0, -half_height, 0};
Point(2) = {width, -half_height, 0};
Point(3) = {width, half_height, 0};
Point(4) = {0, half_height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Physical Curve("bottom", 1) = {1};
Physical Curve("top", 2) = {3};
Physical Surface("plate", 3) = {1};

Field[1] = Box;
Field[1].XMax = width;
Field[1].YMax = half_height;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[2] = MathEval;
Field[2].F = Sprintf("Min(%g, Max(%g, %g - %g * y))", coarse, fine, fine, growth);
Background Field = growth > 0 ? 2 : 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
