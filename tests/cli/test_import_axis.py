"""Which column is the axis where nobody says it: taken where the file leaves no choice, asked for else."""

import unittest

import numpy

from foreign import Foreign


class TheAxis(Foreign):
    N = 400
    SAID = ("--map", "unit=deg/s", "--map", "holds=rate")

    def setUp(self):
        super().setUp()
        self.t = [f"{k / 100:.2f}" for k in range(self.N)]
        self.w = [f"{x:.6f}" for x in self.rates(self.N, 1.0, 0.1)]

    def table(self, head, *columns):
        rows = "\n".join(" ".join(map(str, row)) for row in zip(*columns))
        return self.write("t.txt", (head + "\n" if head else "") + rows + "\n")

    def asked(self, path, *said, says):
        self.refuse(2, "import", path, *said, "--out", self.folder / "o.csv", says=("axis=COLUMN", *says))

    def test_a_sign_or_a_switch_is_none(self):
        sign, switch = [1 - k // 50 % 2 * 2 for k in range(self.N)], [k // 50 % 2 for k in range(self.N)]
        angle = [f"{k * 0.3:.6f}" for k in range(self.N)]
        for state in (sign, switch):
            self.asked(self.table("", self.t, state), *self.SAID, "--map", "time=1", "--map", "time_unit=s", says=())
            self.mean(self.table("t_s w mode", self.t, self.w, state), *self.SAID)
            log = self.angles(self.table("t_s angle_arcsec mode", self.t, angle, state), "--map", "holds=angle", rows=self.N - 1)
            self.assert_turns(log, [0.3] * (self.N - 1), rel=1e-4)

    def test_beside_an_angle_without_a_name_and_words_that_are_unread(self):
        temperature = [24 + k % 5 / 10 for k in range(self.N)]
        said = (*self.SAID, "--map", "time=1", "--map", "time_unit=s")
        for other in ([k * 0.3 for k in range(self.N)], [f"{k}#5" for k in range(self.N)]):
            self.asked(self.table("", self.t, other, temperature), *said, says=("of 3",))
            self.mean(self.table("", self.t, other, temperature), *said, "--map", "axis=3")

    def test_what_is_said_of_a_rate_is_none(self):
        other = [0.05 + k % 3 / 1000 for k in range(self.N)]
        for name in ("sigma_dps", "gyro_std [deg/s]", "range_dps", "bias_dps"):
            name = name.replace(" ", "_")
            self.asked(self.table(f"t_s {name} gyro", self.t, other, self.w), says=(f"'{name}', 'gyro'",))
            self.mean(self.table(f"t_s {name}", self.t, other))
        for name in ("gyro[deg/min]", "rate_deg_min"):
            self.mean(self.table(f"t_s {name} temperature", self.t, self.w, other))

    def test_exponents_of_fortran(self):
        rows = [f"{x:.8E}" for x in map(float, self.w)]
        path = self.table("", self.t, [row.replace("E", "D") for row in rows], [k % 3 for k in range(self.N)])
        log = self.angles(path, *self.SAID, "--map", "axis=2", "--map", "time_unit=s", rows=self.N)
        self.assert_turns(log, numpy.array(rows, float) * 36.0)


if __name__ == "__main__":
    unittest.main()
