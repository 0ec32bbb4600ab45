# The objects of the library, one OpenSCAD file each.
handway_object_meshes(can mug t_shape open_box shelf table desk)
