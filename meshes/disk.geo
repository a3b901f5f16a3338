// Disk of the Brazilian test: centred at the origin, loaded along the y axis by two platens.
// Lengths in metres.
DefineConstant[ size = 0.002 ];      // mesh size
DefineConstant[ platen = 0.003 ];    // half-width of a platen: the rim where |x| <= platen
DefineConstant[ diameter = 0.1 ];
DefineConstant[ seed = 0 ];          // 0 to 10: where the rim is cut, for other meshes of the same size
DefineConstant[ algorithm = 5 ];     // 5: Delaunay, spacings that vary, as a study of non-unified horizons wants; 6: frontal

R = diameter / 2;
y = Sqrt(R * R - platen * platen);
// The rim is cut off the axes, at angles of no symmetry, so that the mesh has none.
a = (11 + 5 * seed) * Pi / 180;
b = (197 + 3 * seed) * Pi / 180;

Point(1) = {0, 0, 0, size};          // centre of the arcs, no node of the mesh
Point(2) = {0, R, 0, size};
Point(3) = {0, -R, 0, size};
Point(4) = {-platen, y, 0, size};
Point(5) = {platen, y, 0, size};
Point(6) = {-platen, -y, 0, size};
Point(7) = {platen, -y, 0, size};
Point(8) = {R * Cos(a), R * Sin(a), 0, size};
Point(9) = {R * Cos(b), R * Sin(b), 0, size};

Circle(1) = {6, 1, 3};
Circle(2) = {3, 1, 7};
Circle(3) = {7, 1, 8};
Circle(4) = {8, 1, 5};
Circle(5) = {5, 1, 2};
Circle(6) = {2, 1, 4};
Circle(7) = {4, 1, 9};
Circle(8) = {9, 1, 6};
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};

Physical Point("pole-top", 1) = {2};
Physical Point("pole-bottom", 2) = {3};
Physical Curve("platen-top", 3) = {5, 6};
Physical Curve("platen-bottom", 4) = {1, 2};
Physical Curve("rim", 5) = {3, 4, 7, 8};   // the rest of the rim, between the platens
Physical Surface("disk", 6) = {1};

Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
