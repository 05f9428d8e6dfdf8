[Metadata]
Name: Triplet of these tests
Focal Length: 40.95
Maximum F Number: 3.16
Squeeze: 1
[Elements]
Radius  Thickness IOR     Housing-Radius Abbe-No Material     Geometry
22      3.25      1.62041 9              60.3    SCHOTT_SK16  SPHERICAL
-436    6         1       9              0       AIR          ASPHERICAL # of the front lens
-22.2   1         1.62    6              36.4    SCHOTT_F2    SPHERICAL
20.3    0.75      1       6              0       AIR          SPHERICAL
0       4         0       5              0       AIR          SPHERICAL
79.7    3         1.7     7              40      UNKNOWN      SPHERICAL
-18.4   42        1       7              0       AIR          SPHERICAL
[Aspheric Coefficients]
1: k=0.5 a2=0 a4=1e-6 a6=2e-9
