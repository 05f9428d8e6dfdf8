"""Where shipped lenses are looked at: near depths that suit each, and those of relays, which are made for one."""

# Ten to thirty focal lengths; with the sensor at the focus of infinity some 5 to 350 waves per pupil radius. Telescopes
# and the microscope objective, whose tube is at infinity, look farther; the floating focus turns to its second column.
NEAR_MM = {
    **{"achromat_f6": 300, "asphere": 300, "cassegrain_f10": 1e5, "cooke_triplet": 1000, "diffractive_singlet": 1000},
    **{"double_gauss_28": 2000, "eye_navarro": 250, "fast_gauss_f14": 2000, "hubble": 1e7, "landscape": 3000},
    **{"macro_floating": 240, "maksutov": 1e5, "microscope_10x": 5000, "periskop": 1000, "petzval": 1500},
    **{"phone_f28": 100, "plano_convex": 300, "reverse_telephoto": 30, "schmidt_camera": 1e4, "singlet_f6": 300},
    **{"telephoto": 3000, "tessar": 60, "wide_angle_35": 700, "zoom_3x": 1000},
}
# Made for objects at unit magnification: one at infinity has no useful image.
RELAYS_MM = {"relay": 95.0, "telecentric_relay": 90.9}
WIDEST_DEG = {"relay": 0.5}  # its entrance pupil is far away; 1° is an object wider than its glass
