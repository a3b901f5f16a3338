// Bar along x of a square section, the middle of its left end at the origin. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.12 ];       // mesh size
DefineConstant[ length = 4.0 ];      // along x
DefineConstant[ side = 1.0 ];        // along y and z

Box(1) = {0, -side/2, -side/2, length, side, side};
Point(9) = {0, 0, 0};                // nodes for supports and gauges
Point(10) = {0, 0, side/4};
Point(11) = {length/4, 0, 0};
Point(12) = {3*length/4, 0, 0};
Point(13) = {length/2, -side/2, 0};
Point(14) = {length/2, side/2, 0};
BooleanFragments{ Volume{1}; Delete; }{ Point{9:14}; Delete; }
e = size/100;
Physical Surface("left", 1) = Surface In BoundingBox{-e, -side, -side, e, side, side};
Physical Surface("right", 2) = Surface In BoundingBox{length - e, -side, -side, length + e, side, side};
Physical Volume("bar", 3) = {1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
