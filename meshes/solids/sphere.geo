// Ball, centred at the origin. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.131 ];      // mesh size
DefineConstant[ radius = 1.0 ];

Sphere(1) = {0, 0, 0, radius};
Physical Surface("surface", 1) = {1};
Physical Volume("ball", 2) = {1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
