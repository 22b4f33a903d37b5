"""fathom cast --lidar: rays, points and images against rational arithmetic, and its refusals."""

import json
import os
import subprocess
from fractions import Fraction

import fathom
import numpy as np
import pytest
from rational_motion import one, placement, rotated, rotation, rounded

cube = os.path.join(os.environ["FATHOM_SOURCE"], "data/meshes/cube.obj")
alone = 4294967295

sensor = {
    "beam_intrinsics": {
        "beam_altitude_angles": [30, 10.5, 0.12, 0, -15.02, -21.95],
        "beam_azimuth_angles": [4.2, 1.42, -1.37, 0, 4.2, -1.4],
        "beam_to_lidar_transform": [1, 0, 0, 15.8, 0, 1, 0, 0, 0, 0, 1, 3.25, 0, 0, 0, 1],
        "lidar_origin_to_beam_origin_mm": 16.1},
    "lidar_data_format": {"pixels_per_column": 6, "columns_per_frame": 16, "pixel_shift_by_row": [1, 0, -2, 0, 17, -1]},
    "lidar_intrinsics": {"lidar_to_sensor_transform": [-1, 0, 0, 1.5, 0, -1, 0, 0, 0, 0, 1, 38.195, 0, 0, 0, 1]},
    "config_params": {"lidar_mode": "16x16"}}

# A turn takes 1/16 s: the shares of the path between poses are v/64.
path = "# time tx ty tz qx qy qz qw\n-1 0 0 0 0 0 0 1\n0 0.1 -0.2 0.05 0 0 0 1\n0.25 0.3 0.1 0 -0.2 0.1 -0.7 -0.9\n"
quaternions = ((1, 0, 0, 0), (-0.9, -0.2, 0.1, -0.7))
positions = ((0.1, -0.2, 0.05), (0.3, 0.1, 0))


def run(*arguments, check=True, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], "cast", *map(str, arguments)], capture_output=True, text=True,
                          env=environment, check=check, **options)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "sensor.json").write_text(json.dumps(sensor))
    (tmp_path / "path.txt").write_text(path)
    return tmp_path


def arctan_of_reciprocal(n):
    total, power, k = 0, one // n, 0
    while power:
        total += (-1) ** k * (power // (2 * k + 1))
        power //= n * n
        k += 1
    return total


pi = Fraction(4 * (4 * arctan_of_reciprocal(5) - arctan_of_reciprocal(239)), one)


def sine_cosine(degrees):
    """Of a rational angle, within 2^-200; exact at multiples of 90 degrees."""
    quarters = round(Fraction(degrees) / 90)
    x = (Fraction(degrees) - 90 * quarters) * pi / 180
    fixed = round(x * one)
    terms, term, k = [0, 0], one, 0
    while term:
        terms[k % 2] += (-1) ** (k // 2) * term
        k += 1
        term = term * fixed // (k * one)
    c, s = (Fraction(each, one) for each in terms)
    if x == 0:
        c, s = Fraction(1), Fraction(0)
    return [(s, c), (c, -s), (-s, -c), (-c, s)][quarters % 4]


def expected_rays(data, moves=False):
    """By the formulas of the reference page, in rational numbers."""
    beams, columns = data["beam_intrinsics"], data["lidar_data_format"]["columns_per_frame"]
    transform = [Fraction(x) for x in beams["beam_to_lidar_transform"]]
    matrix = [Fraction(x) for x in data["lidar_intrinsics"]["lidar_to_sensor_transform"]]
    to_sensor, shift = [matrix[4 * i:4 * i + 3] for i in range(3)], [matrix[4 * i + 3] for i in range(3)]
    rays = {}
    for v in range(columns):
        R, t = placement(positions, quaternions, Fraction(v, 4 * columns)) if moves else (rotation([Fraction(1), 0, 0, 0]), [0, 0, 0])
        s, c = map(rounded, sine_cosine(rounded(Fraction(360 * v, columns))))
        origin = rotated(to_sensor, [transform[3] * c, -transform[3] * s, transform[11]])
        world = rotated(R, [(x + y) / 1000 for x, y in zip(origin, shift)])
        for u, (altitude, azimuth) in enumerate(zip(beams["beam_altitude_angles"], beams["beam_azimuth_angles"])):
            sine, cosine = sine_cosine(rounded(Fraction(360 * v, columns) + Fraction(azimuth)))
            up, level = sine_cosine(altitude)
            direction = rotated(to_sensor, [rounded(cosine * level), rounded(-sine * level), rounded(up)])
            rays[u, v] = [float(x + y) for x, y in zip(world, t)] + [float(x) for x in rotated(R, direction)]
    return np.array([rays[key] for key in sorted(rays)])


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def first_hit(ray, corners):
    """The least t and its triangles; edges belong to both triangles."""
    o, d = [Fraction(x) for x in ray[:3]], [Fraction(x) for x in ray[3:]]
    hits = []
    for number, (a, b, c) in enumerate(corners):
        p, r, s = ([x - y for x, y in zip(end, a)] for end in (b, c, o))
        det = dot(cross(p, r), d)
        if det == 0:
            continue
        v, w, t = dot(cross(s, r), d) / det, dot(cross(p, s), d) / det, -dot(cross(p, r), s) / det
        if v >= 0 and w >= 0 and v + w <= 1 and t >= 0:
            hits.append((t, number))
    return min(hits)[0], [number for t, number in hits if t == min(hits)[0]]


def write_sensor(folder, columns):
    data = json.loads(json.dumps(sensor))
    data["lidar_data_format"]["columns_per_frame"] = columns
    del data["config_params"]
    (folder / "sensor.json").write_text(json.dumps(data))
    return data


@pytest.mark.parametrize("columns", [16, 7])
def test_rays_at_rest_are_those_of_the_formulas(folder, columns):
    data = write_sensor(folder, columns)
    run(cube, "--lidar", "sensor.json", "--write-rays", "rays.npy", cwd=folder)
    assert np.array_equal(np.load(folder / "rays.npy"), expected_rays(data))


def test_rays_on_a_path_are_those_of_the_formulas(folder):
    run(cube, "--lidar", "sensor.json", "--poses", "path.txt", "--start", 0, "--write-rays", "rays.npy", cwd=folder)
    assert np.array_equal(np.load(folder / "rays.npy"), expected_rays(sensor, moves=True))


def test_hits_are_those_of_rational_arithmetic(folder):
    ran = run(cube, "--lidar", "sensor.json", "--poses", "path.txt", "--start", 0, "--channels", "t,id,P,distance", "-o",
              "hits.npz", cwd=folder)
    assert not ran.stderr
    corners = [[[Fraction(float(x)) for x in point] for point in triangle] for triangle in cube_triangles()]
    assert len(corners) == 12
    with np.load(folder / "hits.npz") as hits:
        for k, ray in enumerate(expected_rays(sensor, moves=True)):
            t, numbers = first_hit(ray, corners)
            assert hits["t"][k] == float(t) and hits["id"][k] in numbers
            assert hits["P"][k].tolist() == [float(Fraction(o) + t * Fraction(d)) for o, d in zip(ray[:3], ray[3:])]


def cube_triangles():
    with open(cube) as file:
        lines = [line.split() for line in file]
    points = [[float(x) for x in line[1:4]] for line in lines if line[:1] == ["v"]]
    polygons = [[points[int(each.split("/")[0]) - 1] for each in line[1:]] for line in lines if line[:1] == ["f"]]
    return [(face[0], face[i], face[i + 1]) for face in polygons for i in range(1, len(face) - 1)]


def read_points(file):
    """Points, and the numbers of their rays where the file has them, by NumPy alone."""
    data = file.read_bytes()
    if file.suffix == ".bin":
        return np.frombuffer(data, "<f4").reshape(-1, 4)[:, :3], None
    end, kind = ((b"end_header\n", "<f8") if file.suffix == ".ply" else (b"DATA binary\n", "<f4"))
    header, body = data.split(end, 1)
    records = np.frombuffer(body, [("P", kind, 3), ("id", "<u4"), ("row", "<u4"), ("column", "<u4")])
    count = b"element vertex %d\n" if file.suffix == ".ply" else b"POINTS %d\n"
    assert count % len(records) in header
    return records["P"], records


def is_nearest(value, exact):
    """Whether no neighbour of a float32 number is nearer to a rational number."""
    error = abs(Fraction(float(value)) - exact)
    return all(error <= abs(Fraction(float(np.nextafter(value, np.float32(end)))) - exact) for end in (-np.inf, np.inf))


@pytest.mark.parametrize("name", ["scan.bin", "scan.ply", "scan.pcd"])
@pytest.mark.parametrize("frame", ["world", "sensor", None])
def test_points_are_rounded_once(folder, name, frame):
    run(cube, "--lidar", "sensor.json", "--poses", "path.txt", "--start", 0, "--segment", "0:1.2", "-o", name,
        *(["--frame", frame] if frame else []), cwd=folder)
    rays = expected_rays(sensor, moves=True)
    hits = fathom.Scene.read(cube).cast(rays, tmax=1.2, channels=("t", "id", "P"))
    met = np.isfinite(hits["t"])
    assert 0 < met.sum() < len(rays)
    points, records = read_points(folder / name)
    assert len(points) == met.sum()
    in_sensor = (frame or ("sensor" if name == "scan.bin" else "world")) == "sensor"
    own = expected_rays(sensor)
    corners = [[[Fraction(float(x)) for x in point] for point in triangle] for triangle in cube_triangles()]
    for point, k in zip(points, np.flatnonzero(met)):
        ray, t = (own[k], Fraction(hits["t"][k])) if in_sensor else (rays[k], first_hit(rays[k], corners)[0])
        exact = [Fraction(o) + t * Fraction(d) for o, d in zip(ray[:3], ray[3:])]
        if name == "scan.ply":
            assert point.tolist() == [float(x) for x in exact]
        else:
            assert all(map(is_nearest, point, exact))
    if records is not None:
        assert np.array_equal(records["row"] * 16 + records["column"], np.flatnonzero(met))
        assert np.array_equal(records["id"], hits["id"][met])


@pytest.mark.parametrize("options", [(), ("--destagger",)])
def test_range_images(folder, options):
    for name in ("range.npy", "range.exr"):
        run(cube, "--lidar", "sensor.json", "--segment", "0:1.2", "-o", name, *options, cwd=folder)
    hits = fathom.Scene.read(cube).cast(expected_rays(sensor), tmax=1.2, channels=("id", "distance"))
    shifts = sensor["lidar_data_format"]["pixel_shift_by_row"] if options else [0] * 6
    distance, numbers = (np.array([np.roll(row, shift) for row, shift in zip(hits[name].reshape(6, 16), shifts)])
                         for name in ("distance", "id"))
    assert np.isinf(distance).any() and np.array_equal(np.load(folder / "range.npy"), distance)
    image = fathom.Map.read(folder / "range.exr")
    assert np.array_equal(image["id"], numbers) and (numbers == alone).any()
    assert np.array_equal(image["distance"], distance.astype(np.float32))


def test_written_rays_have_the_same_hits(folder):
    run(cube, "--lidar", "sensor.json", "--poses", "path.txt", "--write-rays", "rays.npy", "-o", "a.npz", cwd=folder)
    run(cube, "--rays", "rays.npy", "-o", "b.npz", cwd=folder)
    assert (folder / "a.npz").read_bytes() == (folder / "b.npz").read_bytes()


def test_python_has_the_same_rays(folder):
    for poses, start in ((None, None), ("path.txt", None), ("path.txt", 0)):
        options = [*(["--poses", poses] if poses else []), *(["--start", start] if start is not None else [])]
        run(cube, "--lidar", "sensor.json", *options, "--write-rays", "rays.npy", cwd=folder)
        rays = fathom.Rays.lidar(folder / "sensor.json", poses and folder / poses, start=start, threads=1)
        assert rays.shape == (6, 16) and rays.camera is None
        both = np.concatenate([rays.origins, rays.directions], axis=-1)
        assert np.array_equal(both.reshape(-1, 6), np.load(folder / "rays.npy"))


def test_faults_in_python(folder):
    with pytest.raises(ValueError, match="start: needs poses"):
        fathom.Rays.lidar(folder / "sensor.json", start=1)
    with pytest.raises(fathom.InputError, match="path.txt: the poses end at 0.25 s, but the sensor measures at 1 s"):
        fathom.Rays.lidar(folder / "sensor.json", folder / "path.txt", start=1)
    with pytest.raises(TypeError, match="sensor: expected the name of a file"):
        fathom.Rays.lidar(None)


def test_a_failure_leaves_no_rays(folder):
    ran = run("missing.obj", "--lidar", "sensor.json", "--write-rays", "rays.npy", check=False, cwd=folder)
    assert ran.returncode == 3 and not (folder / "rays.npy").exists()


def test_old_metadata_without_groups(folder):
    old = {**sensor["beam_intrinsics"], **sensor["lidar_intrinsics"], "data_format": sensor["lidar_data_format"],
           "lidar_mode": "16x16"}
    (folder / "old.json").write_text(json.dumps(old))
    for name in ("sensor.json", "old.json"):
        run(cube, "--lidar", name, "--poses", "path.txt", "--write-rays", f"{name}.npy", cwd=folder)
    assert (folder / "sensor.json.npy").read_bytes() == (folder / "old.json.npy").read_bytes()


def changed(group, key, value=None):
    data = json.loads(json.dumps(sensor))
    if value is None:
        del data[group][key]
    else:
        data[group][key] = value
    return json.dumps(data)


not_rigid = "lidar_to_sensor_transform: expected a rotation and a translation in millimetres, row by row"


def scaled(factor):
    """A rotation times a factor."""
    return [-factor, 0, 0, 0, 0, -factor, 0, 0, 0, 0, factor, 38.195, 0, 0, 0, 1]


@pytest.mark.parametrize("text, message", [
    ("", "bad.json: "),
    ("[]", "bad.json: "),
    ("{}", "'pixels_per_column' is missing; expected the metadata of an Ouster sensor"),
    (changed("beam_intrinsics", "beam_azimuth_angles"), "'beam_azimuth_angles' is missing"),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform"), "'lidar_to_sensor_transform' is missing"),
    (changed("beam_intrinsics", "beam_altitude_angles", [1, 2, 3]), "beam_altitude_angles: "),
    (changed("beam_intrinsics", "beam_altitude_angles", [1, 2, 3, 4, 5, "a"]), "beam_altitude_angles[5]: "),
    (json.dumps(sensor).replace("21.95", "NaN"), "line 1: "),
    (json.dumps(sensor).replace("21.95", "1e999"), "bad.json: "),
    (changed("lidar_data_format", "columns_per_frame", 0), "columns_per_frame: "),
    (changed("lidar_data_format", "pixel_shift_by_row", [1, 2, 3, 4, 5, 0.5]), "expected whole numbers of columns"),
    (changed("beam_intrinsics", "beam_to_lidar_transform", [0] * 16), "expected the last row to be 0 0 0 1"),
    (changed("beam_intrinsics", "beam_to_lidar_transform", [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
     "expected a translation along x and z"),
    (changed("config_params", "lidar_mode", "32x10"), "expected 16xN for N turns in a second, found '32x10'"),
    (changed("config_params", "lidar_mode"), "'lidar_mode' is missing"),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform", [1.7e308, 1.7e308] + [0] * 13 + [1]), not_rigid),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform", scaled(1.0002)), not_rigid),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform", scaled(0.001)), not_rigid),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]), not_rigid),
    (changed("lidar_intrinsics", "lidar_to_sensor_transform", [1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), not_rigid),
])
def test_bad_metadata_is_one_line(folder, text, message):
    (folder / "bad.json").write_text(text)
    ran = run(cube, "--lidar", "bad.json", "--poses", "path.txt", "-o", "scan.bin", check=False, cwd=folder)
    assert ran.returncode == 3 and message in ran.stderr and ran.stderr.count("\n") == 1
    assert not (folder / "scan.bin").exists()


def test_a_rotation_may_have_four_decimals(folder):
    """Its rays are exact products with the given matrix."""
    matrix = [0.8660, -0.5, 0, 7.5, 0.5, 0.8660, 0, -3, 0, 0, 1, 38.195, 0, 0, 0, 1]
    text = changed("lidar_intrinsics", "lidar_to_sensor_transform", matrix)
    (folder / "sensor.json").write_text(text)
    run(cube, "--lidar", "sensor.json", "--write-rays", "rays.npy", cwd=folder)
    assert np.array_equal(np.load(folder / "rays.npy"), expected_rays(json.loads(text)))


def test_a_ray_beyond_binary64_is_one_line(folder):
    far = [1, 0, 0, 1.7e308, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    (folder / "far.json").write_text(changed("lidar_intrinsics", "lidar_to_sensor_transform", far))
    (folder / "far.txt").write_text("0 1.797e308 0 0 0 0 0 1\n")
    ran = run(cube, "--lidar", "far.json", "--poses", "far.txt", "-o", "scan.bin", check=False, cwd=folder)
    assert ran.returncode == 3 and "far.json: the ray of beam 0 in column 0 is beyond binary64" in ran.stderr
    assert ran.stderr.count("\n") == 1 and not (folder / "scan.bin").exists()


@pytest.mark.parametrize("text, start, message", [
    ("", 0, "bad.txt: holds no pose"),
    ("0 0 0 0 0 0 0\n", 0, "line 1: expected time tx ty tz qx qy qz qw, 8 numbers, found 7"),
    ("0 0 0 0 0 0 0 0\n", 0, "line 1: the quaternion is zero"),
    ("0 0 0 nan 0 0 0 1\n", 0, "line 1: the pose has a number that is not finite"),
    ("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", 1, "line 2: the time is not after the time of the pose before"),
    ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", 0.5, "the poses begin at 1 s, but the sensor measures at 0.5 s"),
    ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", 1.96875, "the poses end at 2 s, but the sensor measures at 2.02734375 s"),
])
def test_bad_paths_are_one_line(folder, text, start, message):
    (folder / "bad.txt").write_text(text)
    ran = run(cube, "--lidar", "sensor.json", "--poses", "bad.txt", "--start", start, check=False, cwd=folder)
    assert ran.returncode == 3 and message in ran.stderr and ran.stderr.count("\n") == 1


def test_a_path_may_end_at_the_last_column(folder):
    """Column 15 measures 15/256 s after the start; the nearest double to the exact sum is before it and ends the path."""
    start = 0.013
    end = float(Fraction(start) + Fraction(15, 256))
    assert Fraction(end) < Fraction(start) + Fraction(15, 256)
    for last, status in ((end, 0), (float(np.nextafter(end, 0)), 3)):
        (folder / "short.txt").write_text(f"{start} 0 0 0 0 0 0 1\n{last!r} 1 0 0 0 0 0 1\n")
        ran = run(cube, "--lidar", "sensor.json", "--poses", "short.txt", "-o", "scan.bin", check=False, cwd=folder)
        assert ran.returncode == status, ran.stderr


def test_a_scan_without_points_has_a_warning(folder):
    for name in ("scan.bin", "range.npy"):
        ran = run(cube, "--lidar", "sensor.json", "--segment", "1000:2000", "-o", name, cwd=folder)
        assert "warning: no beam meets the scene" in ran.stderr and ran.stderr.count("\n") == 1
    assert (folder / "scan.bin").read_bytes() == b""
    assert not run(cube, "--lidar", "sensor.json", "-o", "scan.bin", cwd=folder).stderr


@pytest.mark.parametrize("options, message", [
    ((), "--rays or --lidar is required"),
    (("--rays", "rays.csv", "--poses", "path.txt"), "need --lidar"),
    (("--rays", "rays.csv", "-o", "scan.bin"), "does not end in .csv or .npz"),
    (("--lidar", "sensor.json", "-o", "scan.bin", "--mode", "all"), "are for --mode nearest"),
    (("--lidar", "sensor.json", "-o", "scan.bin", "--channels", "t"), "--channels is for tables"),
    (("--lidar", "sensor.json", "--frame", "lidar"), "--frame: 'lidar' is neither world nor sensor"),
    (("--lidar", "sensor.json", "-o", "scan.jpg"), "does not end in .csv, .npz, .bin, .ply, .pcd, .npy or .exr"),
    (("--lidar", "sensor.json", "--start", "1"), "--start needs --poses"),
    (("--lidar", "sensor.json", "-o", "range.exr", "--frame", "world"), "--frame is for points"),
    (("--lidar", "sensor.json", "--frame", "world"), "--frame is for points"),
    (("--lidar", "sensor.json", "-o", "scan.bin", "--destagger"), "--destagger is for range images"),
])
def test_wrong_usage(folder, options, message):
    ran = run(cube, *options, check=False, cwd=folder)
    assert ran.returncode == 2 and message in ran.stderr
    assert sorted(each.name for each in folder.iterdir()) == ["path.txt", "sensor.json"]
