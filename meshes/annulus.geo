// Ring centred at the origin. Lengths in metres.
DefineConstant[ size = 0.00485 ];    // mesh size
DefineConstant[ inner = 0.1 ];       // inner radius
DefineConstant[ outer = 0.2 ];       // outer radius

Point(1) = {0, 0, 0, size};
Point(2) = {inner, 0, 0, size};
Point(3) = {0, inner, 0, size};
Point(4) = {-inner, 0, 0, size};
Point(5) = {0, -inner, 0, size};
Point(6) = {outer, 0, 0, size};
Point(7) = {0, outer, 0, size};
Point(8) = {-outer, 0, 0, size};
Point(9) = {0, -outer, 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 8};
Circle(7) = {8, 1, 9};
Circle(8) = {9, 1, 6};
Curve Loop(1) = {5:8};
Curve Loop(2) = {1:4};
Plane Surface(1) = {1, 2};

Physical Curve("inside", 1) = {1:4};
Physical Curve("outside", 2) = {5:8};
Physical Surface("ring", 3) = {1};

Mesh.Algorithm = 6;                  // Frontal-Delaunay
Mesh.MshFileVersion = 4.1;
