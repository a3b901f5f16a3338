// An eighth of a cube with a spherical cavity in its middle, the origin; finer at the cavity. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ fine = 0.12 ];       // mesh size at the cavity
DefineConstant[ coarse = 0.9 ];      // largest
DefineConstant[ growth = 0.2 ];      // of the size over the distance from the cavity
DefineConstant[ radius = 1.0 ];      // of the cavity
DefineConstant[ half = 5.0 ];        // half of the cube's edge

Box(1) = {0, 0, 0, half, half, half};
Sphere(2) = {0, 0, 0, radius, 0, Pi/2, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
e = fine/100;
Physical Surface("plane-x", 1) = Surface In BoundingBox{-e, -e, -e, e, half + e, half + e};
Physical Surface("plane-y", 2) = Surface In BoundingBox{-e, -e, -e, half + e, e, half + e};
Physical Surface("plane-z", 3) = Surface In BoundingBox{-e, -e, -e, half + e, half + e, e};
Physical Surface("top", 4) = Surface In BoundingBox{-e, -e, half - e, half + e, half + e, half + e};
Physical Surface("cavity", 5) = Surface In BoundingBox{-e, -e, -e, radius + e, radius + e, radius + e};
Physical Volume("block", 6) = {3};

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, %g + %g*(Sqrt(x*x + y*y + z*z) - %g))", coarse, fine, growth, radius);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MshFileVersion = 4.1;
