# a zoom of rows, after the renderers of polynomial optics
#!scale 0.5
44.0      6.5              SK16  1.62041 60.32  18
-872.0    2.0 / 6.0 / 12.0 air                  18
100000    8.0              iris                 10
-44.4     2.0              F2    1.62004 36.37  12
160.0     80.0/76.0/70.0   air                  12 #!aspheric=0.5,1e-7,0,0,0
