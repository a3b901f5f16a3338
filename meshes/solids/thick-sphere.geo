// An eighth of a thick sphere, centred at the origin. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.14 ];       // mesh size
DefineConstant[ inner = 1.0 ];       // radii
DefineConstant[ outer = 2.0 ];

Sphere(1) = {0, 0, 0, outer, 0, Pi/2, Pi/2};
Sphere(2) = {0, 0, 0, inner, 0, Pi/2, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
e = size/100;
Physical Surface("plane-x", 1) = Surface In BoundingBox{-e, -e, -e, e, outer + e, outer + e};
Physical Surface("plane-y", 2) = Surface In BoundingBox{-e, -e, -e, outer + e, e, outer + e};
Physical Surface("plane-z", 3) = Surface In BoundingBox{-e, -e, -e, outer + e, outer + e, e};
skin() = Abs(Boundary{ Volume{3}; });
skin() -= Surface In BoundingBox{-e, -e, -e, e, outer + e, outer + e};
skin() -= Surface In BoundingBox{-e, -e, -e, outer + e, e, outer + e};
skin() -= Surface In BoundingBox{-e, -e, -e, outer + e, outer + e, e};
inside() = Surface In BoundingBox{-e, -e, -e, inner + e, inner + e, inner + e};
skin() -= inside();
Physical Surface("inside", 4) = inside();
Physical Surface("outside", 5) = skin();
Physical Volume("shell", 6) = {3};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
