// Square plate of 1 mm, forty cells across; the notch is a pre-crack of the case.
h = 2.5e-5;
Point(1) = {0,0,0,h}; Point(2) = {1e-3,0,0,h}; Point(3) = {1e-3,1e-3,0,h}; Point(4) = {0,1e-3,0,h};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1};
Curve Loop(1)={1,2,3,4}; Plane Surface(1)={1};
Physical Curve("bottom")={1}; Physical Curve("top")={3}; Physical Surface("plate")={1};
Mesh.Algorithm=5;
