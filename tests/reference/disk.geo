// Disk of diameter 0.1 m with platens |x| <= w on the rim, loaded along y.
// The size varies along the rim so that no two bonds are tied by symmetry.
// gmsh -2 -format msh41 disk.geo -o disk.msh
SetFactory("Built-in");
R = 0.05;
w = 0.005;
y = Sqrt(R*R - w*w);
Point(1) = {0, 0, 0, 0.0062};
Point(2) = {0, R, 0, 0.0056};
Point(3) = {-w, y, 0, 0.0058};
Point(4) = {-R, 0, 0, 0.0074};
Point(5) = {-w, -y, 0, 0.0062};
Point(6) = {0, -R, 0, 0.006};
Point(7) = {w, -y, 0, 0.0063};
Point(8) = {R, 0, 0, 0.0062};
Point(9) = {w, y, 0, 0.0056};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 8};
Circle(7) = {8, 1, 9};
Circle(8) = {9, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
Physical Point("pole-top", 1) = {2};
Physical Point("pole-bottom", 2) = {6};
Physical Curve("platen-top", 3) = {1, 8};
Physical Curve("platen-bottom", 4) = {4, 5};
Physical Surface("disk", 5) = {1};
Mesh.Algorithm = 5;
Mesh.RandomSeed = 11;
Mesh.RandomFactor = 1e-3;
