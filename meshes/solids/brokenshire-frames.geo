// Notched beam of Brokenshire's torsion test in its two steel frames: the axis of the beam along x through the origin, y across, z up; the notch
// runs down from the upper face at 45 degrees to the axis. A frame fits around an end of the beam, and its arm reaches to either side, where it
// stands on a point, or is pushed there. Finer about the notch. Lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[ fine = 0.0125, coarse = 0.025, length = 0.4, side = 0.1, depth = 0.05, width = 0.005, band = 0.05, growth = 0.05 ];
DefineConstant[ frame = 0.125 ];     // outer side of a frame
DefineConstant[ bar = 0.025 ];       // width of a frame along the beam, and section of its arm
DefineConstant[ reach = 0.1 ];       // from the axis to the end of an arm
DefineConstant[ ligament = fine ];   // size at the plane of the notch below its root, if it is smaller than `fine`
DefineConstant[ near = 0.01 ];       // half-width of the layer of that size
DefineConstant[ steel = coarse ];    // size in the frames, if it is smaller than `coarse`
DefineConstant[ slope = 1 / 3 ];     // by how much these sizes grow with the distance
DefineConstant[ algorithm = 6 ];     // of the surfaces, 5: Delaunay, 6: Frontal-Delaunay

Box(1) = {-length/2, -side/2, -side/2, length, side, side};
Box(2) = {-side, -width/2, side/2 - depth, 2*side, width, 2*depth};
Rotate {{0, 0, 1}, {0, 0, 0}, Pi/4} { Volume{2}; }
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
For end In {-1:1:2}
  x = end*(length - bar)/2 - bar/2;
  Box(10 + end) = {x, -frame/2, -frame/2, bar, frame, frame};
  Box(20 + end) = {x, -reach, -bar/2, bar, 2*reach, bar};
  Box(30 + end) = {x, -side/2, -side/2, bar, side, side};
EndFor
BooleanUnion(40) = { Volume{9}; Delete; }{ Volume{19}; Delete; };
BooleanUnion(41) = { Volume{11}; Delete; }{ Volume{21}; Delete; };
BooleanDifference(42) = { Volume{40}; Delete; }{ Volume{29}; Delete; };
BooleanDifference(43) = { Volume{41}; Delete; }{ Volume{31}; Delete; };
// Points in the middles of the lower edges of the ends of the arms.
For end In {-1:1:2}
  Point(1000 + end) = {end*(length - bar)/2, -reach, -bar/2, bar};
  Point(2000 + end) = {end*(length - bar)/2, reach, -bar/2, bar};
EndFor
BooleanFragments{ Volume{3, 42, 43}; Delete; }{ Point{999, 1001, 1999, 2001}; Delete; }

eps = width/100;
Physical Volume("beam") = {3};
all() = Volume{:};
all() -= {3};
Physical Volume("frames") = {all()};

Field[1] = Box;
Field[1].XMin = -2*band; Field[1].XMax = 2*band;
Field[1].YMin = -side; Field[1].YMax = side;
Field[1].ZMin = -side; Field[1].ZMax = side;
Field[1].Thickness = growth;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Background Field = 1;
If (ligament < fine || steel < coarse)
  Field[2] = MathEval;
  Field[2].F = Sprintf("Min(%g, %g + %g * Sqrt(Max(Abs(y - x) / Sqrt(2) - %g, 0)^2 + Max(z - %g, 0)^2))", coarse, ligament, slope, near, side/2 - depth);
  Field[3] = MathEval;
  Field[3].F = Sprintf("Min(%g, %g + %g * Sqrt(Max(%g - Abs(x), 0)^2 + Max(%g - Max(Abs(y), Abs(z)), 0)^2))", coarse, steel, slope, length/2 - bar, side/2);
  Field[4] = Min;
  Field[4].FieldsList = {1, 2, 3};
  Background Field = 4;
EndIf
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMin = Min(width, Min(fine, ligament));
Mesh.MeshSizeMax = coarse;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
