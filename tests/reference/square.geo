// Irregular triangle mesh of a 0.1 x 0.1 m square; the size varies from corner to corner.
// gmsh -2 -format msh41 square.geo -o square.msh
SetFactory("Built-in");
Point(1) = {0.0, 0.0, 0, 0.0085};
Point(2) = {0.1, 0.0, 0, 0.0125};
Point(3) = {0.1, 0.1, 0, 0.0105};
Point(4) = {0.0, 0.1, 0, 0.0145};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Point("corner", 1) = {1};
Physical Curve("bottom", 2) = {1};
Physical Curve("top", 3) = {3};
Physical Surface("square", 4) = {1};
Mesh.Algorithm = 5;
Mesh.RandomSeed = 7;
Mesh.RandomFactor = 1e-3;
