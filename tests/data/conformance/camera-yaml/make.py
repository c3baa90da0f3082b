#!/usr/bin/env python3
"""Writes the camera files of this folder with their expected rays, by the formulas of OpenCV's documentation."""

import json
import math
import pathlib

HERE = pathlib.Path(__file__).parent
RAYS = [(0.0, 0.0), (0.25, 0.0), (-0.3, 0.1), (0.1, -0.2), (-0.15, -0.12)]  # x right, y down, z = 1 ahead


def pinhole(k, d, x, y):
    d = list(d) + [0.0] * (14 - len(d))
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty = d
    r2 = x * x + y * y
    g = (1 + k1 * r2 + k2 * r2**2 + k3 * r2**3) / (1 + k4 * r2 + k5 * r2**2 + k6 * r2**3)
    u = x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r2**2
    v = y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r2**2
    cx, sx, cy, sy = math.cos(tx), math.sin(tx), math.cos(ty), math.sin(ty)
    # R = Ry(ty) Rx(tx); the sensor's point is (R33 u', R33 v') with the third row and column taken out.
    r = [[cy, sy * sx, -sy * cx], [0, cx, sx], [sy, -cy * sx, cy * cx]]
    m = [sum(row[i] * (u, v, 1)[i] for i in range(3)) for row in r]
    a = r[2][2] * m[0] - r[0][2] * m[2]
    b = r[2][2] * m[1] - r[1][2] * m[2]
    return [k[0] * a / m[2] + k[1] + 0.5, k[2] * b / m[2] + k[3] + 0.5]


def fisheye(k, d, x, y):
    r = math.hypot(x, y)
    t = math.atan(r)
    td = t * (1 + d[0] * t**2 + d[1] * t**4 + d[2] * t**6 + d[3] * t**8)
    s = td / r if r > 0 else 1
    return [k[0] * x * s + k[1] + 0.5, k[2] * y * s + k[3] + 0.5]


def rays(model, k, d, turn=lambda x, y, z: (x, y, z)):
    """`turn` takes a ray of the camera, y down and z ahead, to the wall's, likewise."""
    found = []
    for x, y in RAYS:
        a, b, c = turn(x, y, 1.0)
        found.append({"px": model(k, d, x, y), "ray": [a, -b, -c]})
    return found


def matrix(rows, cols, data):
    return (f"!!opencv-matrix\n   rows: {rows}\n   cols: {cols}\n   dt: d\n"
            f"   data: [ {', '.join(repr(float(n)) for n in data)} ]\n")


def k9(k):
    return [k[0], 0, k[1], 0, k[2], k[3], 0, 0, 1]


def opencv(entries, head="%YAML:1.0\n---\n"):
    return head + "".join(f"{name}: {value}" if value.endswith("\n") else f"{name}: {value}\n"
                          for name, value in entries)


def write(name, text, **fields):
    (HERE / f"{name}.yml").write_text(text)
    rule = {"rule": fields.pop("rule"), "file": f"{name}.yml", **fields}
    (HERE / f"{name}.json").write_text(json.dumps(rule, indent=2) + "\n")


K = (64.0, 31.5, 60.0, 15.5)  # fx, cx, fy, cy: the axis is the middle of 64 x 32 pixels
SIZE = [("image_width", "64"), ("image_height", "32")]
FIVE = [-0.21, 0.06, 0.0012, -0.0023, -0.012]
EIGHT = [0.35, 0.08, -0.001, 0.0007, 0.003, 0.62, 0.11, 0.005]
FOURTEEN = [-0.2, 0.05, 0.001, 0.002, -0.004, 0.02, 0.01, 0.001, 0.003, -0.002, 0.0015, 0.001, 0.04, -0.07]
FISH = [0.021, -0.0063, 0.0012, -0.0002]

write("centres-at-integers",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))),
                     ("distortion_coefficients", matrix(5, 1, [0] * 5))]),
      rule="Principal points count from the centre of the first pixel, so half a pixel is added; y points down.",
      rays=[{"px": [32, 16], "ray": [0, 0, -1]}, {"px": [64, 16], "ray": [0.5, 0, -1]},
            {"px": [32, 31], "ray": [0, -0.25, -1]}, {"px": [0, 1], "ray": [-0.5, 0.25, -1]}])

write("five-coefficients",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("distortion_coefficients", matrix(5, 1, FIVE))]),
      rule="k1 k2 p1 p2 k3 of the pinhole model; a pixel sees the ray that the distortion takes to it.",
      rays=rays(pinhole, K, FIVE))

write("fourteen-coefficients",
      opencv([("imageSize", "[ 64, 32 ]"), ("cameraMatrix", matrix(3, 3, k9(K))),
              ("distCoeffs", matrix(1, 14, FOURTEEN))]),
      rule="Rational, thin prism and tilted sensor terms: fourteen coefficients in OpenCV's order.",
      rays=rays(pinhole, K, FOURTEEN))

ROS = """image_width: 64
image_height: 32
camera_name: left_wall
camera_matrix:
  rows: 3
  cols: 3
  data: [64.0, 0.0, 31.5, 0.0, 60.0, 15.5, 0.0, 0.0, 1.0]
distortion_model: {model}
distortion_coefficients:
  rows: 1
  cols: {count}
  data: {data}
rectification_matrix:
  rows: 3
  cols: 3
  data: [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]
projection_matrix:
  rows: 3
  cols: 4
  data: [50.0, 0.0, 30.0, 0.0, 0.0, 50.0, 15.0, 0.0, 0.0, 0.0, 1.0, 0.0]
"""
write("ros-rational", ROS.format(model="rational_polynomial", count=8, data=EIGHT),
      rule="ROS camera_info: pixels of the camera's own picture; its rectification and projection are left out.",
      display="left_wall", rays=rays(pinhole, K, EIGHT))

write("ros-equidistant", ROS.format(model="equidistant", count=4, data=FISH),
      rule="distortion_model equidistant is the fisheye model of k1 k2 k3 k4.",
      display="left_wall", rays=rays(fisheye, K, FISH))

write("ros-message",
      "header:\n  seq: 1\n  frame_id: cam\nheight: 32\nwidth: 64\ndistortion_model: plumb_bob\n"
      f"D: {FIVE}\nK: {[float(n) for n in k9(K)]}\n"
      "R: [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]\n"
      "P: [50.0, 0.0, 30.0, 0.0, 0.0, 50.0, 15.0, 0.0, 0.0, 0.0, 1.0, 0.0]\n",
      rule="A printed CameraInfo message: K and D; R beside P turns a rectified picture and is left out.",
      rays=rays(pinhole, K, FIVE))

write("fisheye-flag",
      opencv(SIZE + [("fisheye_model", "1"), ("camera_matrix", matrix(3, 3, k9(K))),
                     ("distortion_coefficients", matrix(4, 1, FISH))]),
      rule="fisheye_model: 1, as OpenCV's calibration program writes it, is the fisheye model.",
      rays=rays(fisheye, K, FISH))

write("four-coefficients-pinhole",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("dist_coeffs", matrix(4, 1, FIVE[:4]))]),
      rule="Four coefficients fit both models; without a word in the file they are taken for the pinhole's.",
      assumptions={"lens_model": "pinhole"}, rays=rays(pinhole, K, FIVE[:4]))

write("four-coefficients-fisheye",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("dist_coeffs", matrix(4, 1, FISH))]),
      rule="The assumption lens_model makes a fisheye of four coefficients.",
      assume={"lens_model": "fisheye"}, assumptions={"lens_model": "fisheye"}, rays=rays(fisheye, K, FISH))

write("four-coefficients-that-fold",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9((32.0, 31.5, 32.0, 15.5)))),
                     ("dist_coeffs", matrix(4, 1, [-0.1, 0.0, 0.3, 0.1]))]),
      rule="Four coefficients that would fold back inside the picture as a pinhole's but not as a fisheye's are "
           "taken for a fisheye's.",
      assumptions={"lens_model": "fisheye"}, rays=rays(fisheye, (32.0, 31.5, 32.0, 15.5), [-0.1, 0, 0.3, 0.1]))

write("size-from-principal-point",
      opencv([("camera_matrix", matrix(3, 3, k9(K)))]),
      rule="Without a size the principal point is taken for the picture's middle.",
      assumptions={"width_px": "64", "height_px": "32"}, rays=rays(pinhole, K, []))

write("another-size",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K)))]),
      rule="A display of another size shows the same picture resampled: the middle stays the middle.",
      size=[128, 64],
      rays=[{"px": [64, 32], "ray": [0, 0, -1]}, {"px": [128, 32], "ray": [0.5, 0, -1]},
            {"px": [64, 62], "ray": [0, -0.25, -1]}])

write("no-document-start",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K)))], head="%YAML:1.0\n"),
      rule="%YAML:1.0 without the line --- after it, as OpenCV 1 and 2 wrote it.",
      rays=rays(pinhole, K, []))

# A camera that is turned by 30 degrees to the right: its x axis is (cos, 0, -sin) in the world, z (sin, 0, cos).
S, C = math.sin(math.radians(30)), math.cos(math.radians(30))
WORLD_TO_CAMERA = [C, 0, -S, 0, 1, 0, S, 0, C]


def turned(x, y, z):
    return C * x + S * z, y, -S * x + C * z


PROJECTOR = (80.0, 39.5, 80.0, 29.5)
PAIR = opencv([("cam_K", matrix(3, 3, k9(K))), ("cam_kc", matrix(1, 5, FIVE)),
               ("proj_K", matrix(3, 3, k9(PROJECTOR))), ("proj_kc", matrix(1, 5, [0] * 5)),
               ("R", matrix(3, 3, WORLD_TO_CAMERA)), ("T", matrix(3, 1, [-0.2, 0, 0]))])
write("pair-camera", PAIR,
      rule="Of a camera with a projector (cam_K, proj_K, R, T) the camera's axes are the wall's.",
      display="cam", warning="stand 0.2 apart", rays=rays(pinhole, K, FIVE))
write("pair-projector", PAIR,
      rule="R leads from the camera to the projector; a projector is a camera backwards.",
      display="proj", assumptions={"rotation": "world_to_camera"},
      rays=rays(pinhole, PROJECTOR, [], turned))

write("numbered-pair",
      opencv([("M1", matrix(3, 3, k9(K))), ("D1", matrix(1, 5, [0] * 5)), ("M2", matrix(3, 3, k9(PROJECTOR))),
              ("D2", matrix(1, 5, FIVE)), ("R", matrix(3, 3, WORLD_TO_CAMERA)),
              ("R2", matrix(3, 3, [0, 0, 1, 0, 1, 0, -1, 0, 0])), ("P2", matrix(3, 4, [0] * 12))]),
      rule="M1, D1, M2, D2 are two cameras; R2 beside P2 turns a rectified picture and is left out.",
      display="camera1", rays=rays(pinhole, K, []))

write("rotation-vector",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("rvec", matrix(3, 1, [0, -math.radians(30), 0]))]),
      rule="rvec is a rotation by Rodrigues' formula that leads from the world to the camera.",
      assumptions={"rotation": "world_to_camera", "world_axes": "y_down_z_ahead"},
      rays=rays(pinhole, K, [], turned))

write("rotation-of-the-camera",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("R", matrix(3, 3, WORLD_TO_CAMERA))]),
      rule="The assumption rotation turns a matrix that leads from the camera to the world.",
      assume={"rotation": "camera_to_world"},
      rays=rays(pinhole, K, [], lambda x, y, z: (C * x - S * z, y, S * x + C * z)))

write("world-with-z-up",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("R", matrix(3, 3, [1, 0, 0, 0, 0, -1, 0, 1, 0]))]),
      rule="World axes with y ahead and z up: this camera looks along the world's y, level.",
      assume={"world_axes": "y_ahead_z_up"}, rays=rays(pinhole, K, []))

write("principal-point-outside",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9((64.0, 31.5, 64.0, 47.5))))]),
      rule="A principal point outside of the picture is possible (lens shift) and worth a warning.",
      warning="outside of the picture",
      rays=[{"px": [32, 16], "ray": [0, 0.5, -1]}, {"px": [32, 32], "ray": [0, 0.25, -1]}])

write("distortion-that-folds",
      opencv(SIZE + [("camera_matrix", matrix(3, 3, k9((32.0, 31.5, 32.0, 15.5)))),
                     ("distortion_coefficients", matrix(5, 1, [-0.5, 0, 0, 0, 0]))]),
      rule="x (1 - x^2 / 2) turns back at x = sqrt(2/3), 17.4 px off the axis: farther pixels see nothing.",
      warning="turns back inside the picture",
      rays=[{"px": [48, 16], "ray": [0.6180339887498949, 0, -1]}, {"px": [52, 16], "ray": None},
            {"px": [0.5, 0.5], "ray": None}])

write("skew", opencv(SIZE + [("camera_matrix", matrix(3, 3, [64, 0.25, 31.5, 0, 60, 15.5, 0, 0, 1]))]),
      rule="OpenCV's functions never look at a skew; it is left out with a warning.",
      warning="skew of 0.25", rays=rays(pinhole, K, []))

for name, rule, text, error in [
    ("no-camera-matrix", "A file without a camera matrix is no camera.", opencv(SIZE), "a camera matrix"),
    ("not-finite", "Numbers are finite.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K)).replace("31.5", ".Nan"))]), "numbers from -1e6 to 1e6"),
    ("transposed", "The principal point is in the last column.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, [64, 0, 0, 0, 60, 0, 31.5, 15.5, 1]))]), "focal lengths above 0"),
    ("no-focal-length", "A focal length is above 0.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, [0, 0, 31.5, 0, 60, 15.5, 0, 0, 1]))]), "focal lengths above 0"),
    ("eight-numbers", "A camera matrix has nine numbers.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, [64, 0, 31.5, 0, 60, 15.5, 0, 0]))]), "3 x 3 numbers"),
    ("three-coefficients", "There are 0, 4, 5, 8, 12 or 14 distortion coefficients.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("distortion_coefficients", matrix(3, 1, [0] * 3))]),
     "distortion coefficients"),
    ("unknown-model", "A model that is not known is refused, not replaced.",
     ROS.format(model="double_sphere", count=4, data=FISH), "distortion_model"),
    ("mirrored-rotation", "A rotation neither stretches nor mirrors.",
     opencv(SIZE + [("camera_matrix", matrix(3, 3, k9(K))), ("R", matrix(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, -1]))]),
     "a rotation"),
    ("alias", "Aliases, which may form rings, are refused.",
     "image_width: &w 64\nimage_height: *w\n", "an alias"),
    ("deep-nesting", "Nesting is bounded.", "a: " + "[" * 20000 + "\n", "YAML"),
    ("a-list", "The file is a map of names.", "- 1\n- 2\n", "a map of names"),
]:
    write(name, text, rule=rule, error=error)
