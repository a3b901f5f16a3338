// Notched beam of Brokenshire's torsion test, its axis along x through the origin, y across, z up; the notch runs down from the upper face at
// 45 degrees to the axis. Finer about the notch. Lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[ fine = 0.01, coarse = 0.025, length = 0.4, side = 0.1, depth = 0.05, width = 0.005, arm = 0.05, band = 0.05, growth = 0.05 ];

Box(1) = {-length/2, -side/2, -side/2, length, side, side};
Box(2) = {-side, -width/2, side/2 - depth, 2*side, width, 2*depth};
Rotate {{0, 0, 1}, {0, 0, 0}, Pi/4} { Volume{2}; }
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

eps = width/100;
left() = Surface In BoundingBox{-length/2 - eps, -side, -side, -length/2 + eps, side, side};
right() = Surface In BoundingBox{length/2 - eps, -side, -side, length/2 + eps, side, side};
Physical Surface("left") = {left()};
Physical Surface("right") = {right()};
Physical Volume("beam") = {3};

Field[1] = Box;
Field[1].XMin = -2*band; Field[1].XMax = 2*band;
Field[1].YMin = -side; Field[1].YMax = side;
Field[1].ZMin = -side; Field[1].ZMax = side;
Field[1].Thickness = growth;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMin = Min(width, fine);
Mesh.MeshSizeMax = coarse;
Mesh.MshFileVersion = 4.1;
