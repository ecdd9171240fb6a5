# SPDX-License-Identifier: MIT OR Apache-2.0
"""The peers that PyPI has, on one case: python peers.py open3d|fcpw|libigl CASE_DIRECTORY.

Prints the lines of benches/peers/case/src/report.rs; one `skipped` line where the package cannot be used.
All of a set is asked in one call, so that Python costs nothing; one core is what taskset gives it.
"""

import sys
import time
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import numpy as np

SETS = ("uniform", "near", "grid")


class Case:
    """A mesh, its points, and exact distances at some of them."""

    def __init__(self, directory):
        self.directory = Path(directory)
        self.name = self.directory.name
        self.vertices = np.fromfile(self.directory / "vertices.f64", "<f8").reshape(-1, 3)
        self.triangles = np.fromfile(self.directory / "triangles.u32", "<u4").reshape(-1, 3)
        self.diagonal = np.linalg.norm(np.ptp(self.vertices, axis=0))

    def points(self, name):
        return np.fromfile(self.directory / f"{name}.f64", "<f8").reshape(-1, 3)

    def judge(self, name, answers, signed, tolerance):
        """The worst error in diagonals, and the number of wrong signs or a dash."""
        at = np.fromfile(self.directory / f"{name}.at.u32", "<u4")
        exact = np.fromfile(self.directory / f"{name}.exact.f64", "<f8")
        got = np.asarray(answers, dtype=np.float64)[at]
        error = np.abs(np.abs(got) - np.abs(exact)) / self.diagonal
        worst = float(np.max(np.where(np.isnan(error), np.inf, error)))
        clear = np.abs(exact) > tolerance * self.diagonal
        wrong = int(np.sum(clear & ((got < 0) != (exact < 0)))) if signed else "-"
        return worst, wrong


def seconds(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


class Open3D:
    """Embree's closest point; the sign by counting crossings of rays."""

    package, module, name = "open3d-cpu", "open3d", "Open3D"
    what = "f32 (Embree), signed by rays, PyPI"
    signed, tolerance = True, 1e-4

    def __init__(self, open3d, case):
        self.tensor = open3d.core.Tensor
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        # Small meshes a long way from 1 lose digits in f32: the scene is the box of size 1.
        self.shift, self.scale = case.vertices.min(axis=0), case.diagonal
        vertices = ((case.vertices - self.shift) / self.scale).astype(np.float32)
        self.scene.add_triangles(self.tensor(vertices), self.tensor(case.triangles.astype(np.uint32)))
        self.ask(self.prepare(case.vertices[:1]))  # Embree builds at the first question.

    def prepare(self, points):
        return self.tensor(((points - self.shift) / self.scale).astype(np.float32))

    def ask(self, prepared):
        return self.scene.compute_signed_distance(prepared, nthreads=1)

    def distances(self, answer):
        return answer.numpy().astype(np.float64) * self.scale


class FCPW:
    """Closest points only: the package's own sign is another question."""

    package, module, name = "fcpw", "fcpw", "FCPW"
    what = "f32, unsigned, PyPI"
    signed, tolerance = False, 1e-4

    def __init__(self, fcpw, case):
        self.fcpw = fcpw
        self.shift, self.scale = case.vertices.min(axis=0), case.diagonal
        self.scene = fcpw.scene_3D()
        self.scene.set_object_count(1)
        self.scene.set_object_vertices(self.scaled(case.vertices), 0)
        self.scene.set_object_triangles(case.triangles.astype(np.int32), 0)
        self.scene.build(fcpw.aggregate_type.bvh_surface_area, True)

    def scaled(self, points):
        return ((points - self.shift) / self.scale).astype(np.float32)

    def prepare(self, points):
        radii = np.full(len(points), np.inf, np.float32)
        return np.asfortranarray(self.scaled(points)), radii, self.fcpw.interaction_3D_list()

    def ask(self, prepared):
        self.scene.find_closest_points(*prepared)
        return prepared[2]

    def distances(self, answer):
        return np.fromiter((one.d for one in answer), np.float64, len(answer)) * self.scale


class Libigl:
    """A tree of boxes, the sign from pseudonormals. The tree is built in every call: that time is taken off."""

    package, module, name = "libigl", "igl", "libigl"
    what = "f64, signed, PyPI; its build taken off"
    signed, tolerance = True, 1e-9

    def __init__(self, igl, case):
        self.igl = igl
        self.mesh = np.ascontiguousarray(case.vertices), case.triangles.astype(np.int64)
        self.ask(self.prepare(case.vertices[:1]))

    def prepare(self, points):
        return np.ascontiguousarray(points)

    def ask(self, prepared):
        kind = self.igl.SignedDistanceType.SIGNED_DISTANCE_TYPE_PSEUDONORMAL
        return self.igl.signed_distance(prepared, *self.mesh, sign_type=kind)[0]

    def distances(self, answer):
        return answer


PEERS = {"open3d": Open3D, "fcpw": FCPW, "libigl": Libigl}


def measure(kind, case):
    module = import_module(kind.module)
    built, peer = seconds(lambda: kind(module, case))
    print("peer", kind.name, version(kind.package), kind.what, sep="\t")
    print("row", case.name, "build", kind.name, f"{built:e}", "s", "-", "-", "-", sep="\t")
    for name in SETS:
        points = case.points(name)
        peer.ask(peer.prepare(points[::10]))
        one = peer.prepare(points[:1])
        spent = seconds(lambda: peer.ask(one))[0] if kind is Libigl else 0.0
        prepared = peer.prepare(points)
        passed, answer = seconds(lambda: peer.ask(prepared))
        worst, wrong = case.judge(name, peer.distances(answer), kind.signed, kind.tolerance)
        each = (passed - spent) * 1e9 / len(points)
        tail = f"{worst:e}", wrong, f"{kind.tolerance:e}"
        print("row", case.name, name, kind.name, f"{each:e}", "ns", *tail, sep="\t", flush=True)


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in PEERS:
        sys.exit(__doc__)
    kind = PEERS[sys.argv[1]]
    try:
        case = Case(sys.argv[2])
        measure(kind, case)
    except ImportError as error:
        print("skipped", kind.name, " ".join(str(error).split()), sep="\t")


if __name__ == "__main__":
    main()
