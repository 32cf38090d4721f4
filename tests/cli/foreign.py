"""Files of other programs, made for tests, and what becomes of them."""

import json
import struct

import numpy

from support import AngleLog, CliTest

SCALE = ["--map", "scale_arcsec=3.263"]
FIXED = ["--map", "mode=always:1", "--map", "loop_closed=always:1"]


def matlab5(variables):
    """A MATLAB 5 file of matrices of doubles, by hand from MathWorks' description of the format."""
    def element(kind, data):
        return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)
    out = b"MATLAB 5.0 MAT-file, made by a test".ljust(116, b" ") + bytes(8) + struct.pack("<HH", 0x0100, 0x4D49)
    for name, matrix in variables.items():
        matrix = numpy.atleast_2d(numpy.asarray(matrix, float))
        body = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", *matrix.shape))
        body += element(1, name.encode()) + element(9, matrix.tobytes(order="F"))
        out += element(14, body)
    return out


class Foreign(CliTest):
    def setUp(self):
        super().setUp()
        self.rng = numpy.random.default_rng(20)

    def rates(self, n=600, mean=15.04, sigma=3.0):
        """deg/h"""
        return mean + sigma * self.rng.standard_normal(n)

    def angles(self, path, *said, rows=None):
        out = self.folder / "angles.csv"
        self.succeed("import", path, "--out", out, "--force", *said)
        log = AngleLog(out)
        if rows is not None:
            self.assertEqual(len(log.rows), rows)
        return log

    def assert_turns(self, log, expected, rel=1e-12):
        numpy.testing.assert_allclose(log.dtheta, expected, rtol=rel, atol=1e-12)
        self.assertEqual(log.final, log.dtheta)
        self.assertTrue(all(sigma == float("inf") for sigma in log.sigma))

    def mean(self, path, *said):
        axis = json.loads(self.succeed("analyze", path, *said, "--json").stdout)["axes"][0]
        return axis["mean_rate_arcsec_s"], axis
