// Beam of 160 x 40 x 40 mm around the origin, with strips of 10 mm across it for two supports and a load.
DefineConstant[ size = 0.010 ];
xs[] = {-0.08, -0.075, -0.065, -0.005, 0.005, 0.065, 0.075, 0.08};
n = 8;
For i In {0:n-1}
  Point(10*i+1) = {xs[i], -0.02, -0.02, size};
  Point(10*i+2) = {xs[i],  0.02, -0.02, size};
EndFor
For i In {0:n-2}
  Line(100*i+1) = {10*i+1, 10*(i+1)+1};
  Line(100*i+2) = {10*i+2, 10*(i+1)+2};
EndFor
Line(1001) = {1, 2};
Line(1002) = {10*(n-1)+1, 10*(n-1)+2};
bottom[] = {}; top[] = {};
For i In {0:n-2}
  bottom[] += {100*i+1};
  top[] += {-(100*(n-2-i)+2)};
EndFor
Curve Loop(1) = {bottom[], 1002, top[], -1001};
Plane Surface(1) = {1};
out[] = Extrude {0, 0, 0.04} { Surface{1}; };
Physical Volume("beam") = {out[1]};
// Side surfaces in the order of the loop: bottom strips, right end, top strips (from right), left end.
Physical Surface("left-support") = {out[2+1]};
Physical Surface("right-support") = {out[2+5]};
Physical Surface("load") = {out[2+7+1+3]};
