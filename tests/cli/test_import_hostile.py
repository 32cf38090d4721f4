"""Files that would crash `zlg import`, keep it busy or fill the memory: each costs little, and is refused in one line or read right."""

import io
import struct
import subprocess
import zlib

import h5py
import numpy

from foreign import Foreign
from support import ZLG

HEAD = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM"
W = ["--map", "axis=2", "--map", "holds=rate", "--map", "unit=arcsec/s"]
FIXED_RATE = ["--map", "time=none", "--map", "rate_hz=100"]


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


class Hostile(Foreign):
    def cheap(self, *args, code=None):
        """Within 2 s of processor time and 300 MB. Exit 2 or 3 come with one line."""
        cost = self.folder / "cost"
        result = subprocess.run(["/usr/bin/time", "-q", "-f", "%U %S %M", "-o", cost, "timeout", "60", ZLG, *map(str, args)], capture_output=True,
                                text=True)
        user, system, kilobytes = map(float, cost.read_text().split())
        self.assertLess(user + system, 2.0)
        self.assertLess(kilobytes, 300e3)
        self.assertIn(result.returncode, (0, 2, 3), result.stderr)
        if result.returncode != 0:
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        if code is not None:
            self.assertEqual(result.returncode, code, result.stderr)
        return result

    def hdf5(self, make, **said):
        path = self.folder / "a.h5"
        with h5py.File(path, "w", **said) as file:
            make(file)
        return path


class Npy(Hostile):
    def array(self, head, data, version=2):
        return self.write("a.npy", b"\x93NUMPY" + bytes([version, 0]) + struct.pack("<I", len(head)) + head.encode() + data)

    def test_the_usual_spellings_are_read_as_numpy_does(self):
        for order in ("'fortran_order':True", "'fortran_order':  True", "'fortran_order': False"):
            for form in ("{{'descr': '<f8', {}, 'shape': (50, 3), }}", "{{'descr': '<f8',{},'shape':(50,3)}}   \n"):
                data = self.rates(150).tobytes()
                path = self.array(form.format(order), data)
                expected = numpy.load(path)[:, 1]
                self.assert_turns(self.angles(path, *W, *FIXED_RATE), expected / 100)

    def test_what_numpy_does_not_read_or_reads_otherwise_is_refused(self):
        for head in ("{}", "{'descr': '<f8', 'fortran_order': 1, 'shape': (50, 3)}", "{'descr': '<f8', 'fortran_order': Trueish, 'shape': (150,)}",
                     "{'descr': '<f8', 'fortran_order': True, 'shape': (150)}", "{'descr': '<f8', 'fortran_order': True, 'shape': (150,,)}",
                     "{'descr': '<f8', 'fortran_order': not True, 'shape': (150,)}", "{'descr': '<f8', 'fortran_order': True, 'shape': (150,)} or {}",
                     "{'descr': '\\x3cf8', 'fortran_order': True, 'shape': (150,)}", "{'descr': '<f8', 'fortran_order': True, 'shape': (5 0, 3)}",
                     "{'descr': '<f8', 'fortran_order': True, 'shape': (" + "9" * 30 + ",)}", "{'descr':" + " " * 900 + "'<f8'"):
            self.cheap("import", self.array(head, bytes(1200)), code=3)

    def test_a_head_of_many_blanks_is_only_long(self):
        blanks = "{'descr':%s'<f8', 'fortran_order': False, 'shape': (50, 3), }"
        self.cheap("import", self.array(blanks % (" " * 900), bytes(1200)), code=0)
        self.assertIn("head of 60", self.cheap("import", self.array(blanks % (" " * 60_000), bytes(1200)), code=3).stderr)

    def test_a_version_that_numpy_does_not_know(self):
        path = self.array("{'descr': '<f8', 'fortran_order': False, 'shape': (50, 3)}", bytes(1200))
        self.cheap("import", path, code=0)
        path.write_bytes(path.read_bytes()[:7] + b"\xff" + path.read_bytes()[8:])
        self.assertIn("of version 2.255", self.cheap("import", path, code=3).stderr)


class Hdf5(Hostile):
    def test_links_to_its_own_groups(self):
        def make(file):
            file["t_s"], file["w"] = numpy.arange(60) / 100, self.rates(60)
            for k in range(12):
                file[f"l{k}"] = file["/"]
        path = self.hdf5(make)
        self.cheap("import", path, code=0)
        self.assert_turns(self.angles(path, *W), self.rates_of(path) / 100)

    def rates_of(self, path):
        with h5py.File(path) as file:
            return file["w"][()]

    def test_values_that_were_never_written(self):
        for n in (1, 10):
            path = self.hdf5(lambda file: [file.create_dataset(f"w{k}", (1 << 28,), "f8") for k in range(n)])
            self.assertIn("ever written", self.cheap("import", path, code=3).stderr)
        # One row of each chunk is there.
        def sparse(file):
            for k in range(40):
                file.create_dataset(f"w{k}", (1 << 20,), "f8", chunks=(1 << 10,))[0] = 1.0
        self.assertIn("allowed are", self.cheap("import", self.hdf5(sparse), code=3).stderr)

    def test_chunks_that_unpack_to_a_gigabyte(self):
        packer = zlib.compressobj(9)
        packed = b"".join(packer.compress(bytes(1 << 20)) for _ in range(1 << 10)) + packer.flush()
        for n in (1000, 1 << 19, 1 << 27):
            path = self.hdf5(lambda file: file.create_dataset("w", (n,), "f8", chunks=(n,), compression="gzip").id.write_direct_chunk((0,), packed))
            self.cheap("import", path, code=3)

    def test_chunks_below_64_kib_that_unpack_to_more_than_their_values(self):
        packed = zlib.compress(bytes(60 << 20), 9)
        def make(file):
            w = file.create_dataset("w", (30 * 128,), "f8", chunks=(128,), compression="gzip")
            for k in range(30):
                w.id.write_direct_chunk((128 * k,), packed)
        self.assertIn("row 1", self.cheap("import", self.hdf5(make), code=3).stderr)
        # Fewer bytes than its values take, of which the library would read on behind them, deflated or not.
        for skipped, chunk in ((0, zlib.compress(bytes(512))), (1, bytes(512))):
            path = self.hdf5(lambda file: file.create_dataset("w", (128,), "f8", chunks=(128,), compression="gzip").id.write_direct_chunk(
                (0,), chunk, filter_mask=skipped))
            self.assertIn("its values take 1024", self.cheap("import", path, code=3).stderr)

    def test_a_filter_that_says_itself_how_much_it_makes(self):
        path = self.hdf5(lambda file: file.create_dataset("w", data=numpy.full(1000, 5, "i4"), chunks=(100,), scaleoffset=0))
        data = path.read_bytes()
        said = struct.pack("<7I", 2, 0, 100, 0, 4, 1, 0)  # of chunks of 100 values
        self.assertEqual(data.count(said), 1)
        path.write_bytes(data.replace(said, struct.pack("<7I", 2, 0, 1 << 29, 0, 4, 1, 0)))
        self.assertIn("'scaleoffset'; allowed are", self.cheap("import", path, code=3).stderr)
        # An own log too.
        self.succeed("run", "--duration", "5", "--out", self.folder / "run")
        log = self.folder / "run" / "angles.h5"
        with h5py.File(log, "r+") as file:
            mode = file["angles/mode"][()]
            del file["angles/mode"]
            file["angles"].create_dataset("mode", data=mode, chunks=(100,), scaleoffset=0)
        self.assertIn("'scaleoffset'; allowed are", self.cheap("inspect", log, code=3).stderr)
        # Packed first, and mixed then: what it unpacks to is not seen.
        def mixed(file):
            creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            creation.set_chunk((100,))
            creation.set_deflate(1)
            creation.set_shuffle()
            h5py.h5d.create(file.id, b"w", h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple((100,)), creation).write(
                h5py.h5s.ALL, h5py.h5s.ALL, self.rates(100))
        self.assertIn("behind deflate", self.cheap("import", self.hdf5(mixed), code=3).stderr)

    def test_many_chunks_of_few_values_and_few_values_in_many_bytes(self):
        def nominal(file):
            file.create_dataset("w", (1_000_000,), "f8", chunks=(1,))[:3] = 1, 2, 3
        def square(file):
            file.create_dataset("w", (1000, 1000), "f8", chunks=(1, 1))[0, :3] = 1, 2, 3
        def wide(file):
            for k in range(200):
                file.create_dataset(f"w{k}", (20,), "f8", maxshape=(None,), chunks=(1_000_000,), compression="gzip")[:] = numpy.arange(20) + k
        for make in (nominal, square, wide):
            self.assertIn("chunks that cost", self.cheap("import", self.hdf5(make), code=3).stderr)
        # Within what is allowed.
        def some(file):
            for k in range(3):
                file.create_dataset(f"w{k}", (10_000,), "f8", chunks=(1,))[:3] = 1, 2, 3
        self.cheap("import", self.hdf5(some), code=0)

    def test_chunks_that_were_never_written_are_missing_samples(self):
        rates = self.rates(6000)
        lost = [k for k in range(6000) if 2000 <= k < 2200 or k >= 5900]
        for libver in ("earliest", "latest"):
            for kind in ({}, {"compression": "gzip"}, {"compression": "gzip", "shuffle": True, "fletcher32": True}, {"fletcher32": True}):
                def make(file):
                    w = file.create_dataset("w", (6000,), "f8", chunks=(100,), **kind)
                    w[:2000], w[2200:5900] = rates[:2000], rates[2200:5900]
                with self.subTest(libver=libver, **kind):
                    path = self.hdf5(make, libver=libver)
                    log = self.angles(path, "--map", "axis=w", *W[2:], *FIXED_RATE, rows=6000)
                    self.assertEqual([k for k in range(6000) if log.has(k, "invalid")], lost)
                    self.assertEqual(log.dtheta[300], rates[300] / 100)
        def matrix(file):
            m = file.create_dataset("m", (3, 6000), "i4", chunks=(2, 100), compression="gzip")
            m[:2], m[2, :2000] = numpy.arange(6000) % 5, 5 + numpy.arange(2000) % 3
        path = self.hdf5(matrix)
        for axis, there in ((1, 6000), (3, 2000)):
            _, analysed = self.mean(path, "--map", f"axis={axis}", *W[2:], *FIXED_RATE)
            self.assertEqual((analysed["samples"], analysed["known"]), (6000, there))

    def test_times_of_whole_nanoseconds(self):
        rates = self.rates(400)
        def make(file):
            file["t_ns"] = 1_700_000_000_123_456_789 + 10_000_000 * numpy.arange(400)
            file["w"], file["n"] = rates, (1 << 60) + numpy.arange(400) % 7
            file["on"], file["cube"] = rates > 0, numpy.zeros((5, 5, 5))
        path = self.hdf5(make)
        self.assert_turns(self.angles(path, "--map", "axis=w", *W[2:], rows=400), rates / 100)
        self.refuse(3, "analyze", path, "--map", "axis=n", *W[2:], says=("'n'", "2^53"))
        for name, why in (("on", "no plain numbers"), ("cube", "dimensions")):
            self.refuse(2, "analyze", path, "--map", f"axis={name}", *W[2:], says=(f"'{name}' is left out", why))

    def test_many_small_chunks_are_right(self):
        rates = self.rates(10000)
        path = self.hdf5(lambda file: file.create_dataset("w", data=numpy.column_stack([rates, -rates]), chunks=(1, 1), compression="gzip"))
        self.cheap("import", path, "--out", self.folder / "o.csv", *W, *FIXED_RATE, code=0)
        self.assert_turns(self.angles(path, *W, *FIXED_RATE), -rates / 100)

    def test_many_groups(self):
        def make(file):
            for k in range(600):
                for j in range(20):
                    file.create_group(f"g{k}/h{j}")
        self.assertIn("groups and arrays", self.cheap("import", self.hdf5(make, libver="latest"), code=3).stderr)


class Matlab(Hostile):
    def test_bombs(self):
        n = 100 << 17
        body = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", n, 1)) + element(1, b"w")
        packer = zlib.compressobj(9)
        packed = packer.compress(struct.pack("<II", 14, len(body) + 8 + 8 * n) + body + struct.pack("<II", 9, 8 * n))
        packed += b"".join(packer.compress(bytes(1 << 20)) for _ in range(100)) + packer.flush()
        one = struct.pack("<II", 15, len(packed)) + packed
        self.cheap("import", self.write("bomb.mat", HEAD + one), code=3)
        for path in (self.folder / "bomb.mat", self.write("bombs.mat", HEAD + 10 * one)):
            self.assertIn("unpacks to", self.cheap("import", path, code=3).stderr)

    def test_an_array_of_structures(self):
        def field(numbers):
            return element(14, element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", len(numbers), 1)) + element(1, b"") +
                           element(9, numbers.tobytes()))
        head = element(6, struct.pack("<II", 2, 0)) + element(5, struct.pack("<ii", 1, 2)) + element(1, b"s") + struct.pack("<HHI", 5, 4, 32)
        path = self.write("two.mat", HEAD + element(14, head + element(1, b"w".ljust(32, b"\0")) + field(self.rates(50)) + field(self.rates(50))))
        self.assertIn("only the first is read", self.cheap("import", path, code=0).stdout)

    def test_structures_without_end(self):
        inner = b""
        for _ in range(2000):
            inner = element(14, element(6, struct.pack("<II", 2, 0)) + element(5, struct.pack("<ii", 1, 1)) + element(1, b"w") +
                            struct.pack("<HHI", 5, 4, 32) + element(1, b"a".ljust(32, b"\0")) + inner)
        self.cheap("import", self.write("deep.mat", HEAD + inner), code=3)
        small = element(14, element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", 9, 1)) + element(1, b"w") + element(9, bytes(72)))
        self.cheap("import", self.write("many.mat", HEAD + 20000 * small), code=3)


class Text(Hostile):
    def test_many_columns_cost_no_more_than_their_bytes(self):
        for columns in (500, 4000, 16000):
            rates = self.rates(20 * columns).reshape(20, columns)
            path = self.write("wide.csv", "".join(",".join(f"{r:.4f}" for r in row) + "\n" for row in rates))
            self.cheap("import", path, code=0)
            self.assert_turns(self.angles(path, *W, *FIXED_RATE), [float(f"{r:.4f}") / 100 for r in rates[:, 1]])

    def test_one_line(self):
        for name, data, code in (("row.txt", " ".join(f"{r:.4f}" for r in self.rates(30000)), 3), ("long.txt", "1" * 10_000_000, 3),
                                 ("parted.txt", "1 " * 5_000_000, 3), ("quotes.txt", '"' * 1_000_000, 3), ("commas.txt", '",' * 400_000, 3),
                                 ("comments.txt", "# a\n" * 500_000, 3), ("ends.txt", "\r" * 3_000_000, 3)):
            with self.subTest(name):
                path = self.write(name, data)
                self.cheap("import", path, code=code)
                self.cheap("analyze", path, "--map", "holds=rate", "--map", "rate_hz=100", code=code)
        self.assertIn("one row", self.cheap("import", self.write("row.txt", "1.5 2.5 3.5\n"), code=3).stderr)

    def test_a_log_of_many_names(self):
        path = self.write("names.csv", ",".join(f"c{k}" for k in range(80_000)) + "\n" + ",".join(["1"] * 80_000) + "\n")
        self.cheap("process", path, "--out", self.folder / "o.csv", code=3)

    def test_a_clock_that_jumps(self):
        for jump, code in ((1000, 0), (int(1e8), 3), (int(1e15), 3)):
            text = "t_s,w\n" + "".join(f"{k + (jump if k > 30 else 0)},{rate:.6f}\n" for k, rate in enumerate(self.rates(60)))
            path = self.write("jump.csv", text)
            result = self.cheap("import", path, "--out", self.folder / "o.csv", "--force", *W, code=code)
            if code:
                for said in ("row 31", "from 30 to 1", "time=none"):
                    self.assertIn(said, result.stderr)
            analysed = self.cheap("analyze", path, *W, code=code)
            self.assertTrue(not code or "row 31" in analysed.stderr, analysed.stderr)
        self.angles(path, *W, *FIXED_RATE, rows=60)


class Times(Hostile):
    """More than one column without a name rises as times do."""

    def test_nothing_is_chosen_in_silence(self):
        said = ["--map", "holds=rate", "--map", "unit=deg/s", "--map", "time_unit=s"]
        rates = self.rates(400)
        columns = {"counter": [f"{k}" for k in range(400)], "s": [f"{k * 0.005:.3f}" for k in range(400)], "ms": [f"{k * 5}" for k in range(400)],
                   "angle": [f"{7.5 + k * 0.25:.2f}" for k in range(400)]}
        for rising in (("counter", "s"), ("s", "counter"), ("ms", "s"), ("s", "ms"), ("s", "angle"), ("angle", "s"), ("counter", "ms", "s")):
            cells = [columns[name] for name in rising] + [[f"{r:.6f}" for r in rates]]
            path = self.write("times.csv", "".join(";".join(row) + "\n" for row in zip(*cells)))
            axis = ["--map", f"axis={len(cells)}"]
            choice = "time=" + "|".join(str(k + 1) for k in range(len(rising)))
            for verb in (["import", path, "--out", self.folder / "o.csv"], ["analyze", path]):
                self.refuse(2, *verb, *axis, *said, says=(choice,))
            self.assertIn(choice, self.succeed("import", path).stdout)
            _, analysed = self.mean(path, *axis, *said, "--map", f"time={rising.index('s') + 1}")
            self.assertAlmostEqual(analysed["rate_hz"], 200, delta=1e-6)
            names = ";".join("time" if name == "s" else name for name in rising) + ";w\n"
            named = self.write("named.csv", names + path.read_text())
            _, analysed = self.mean(named, "--map", "axis=w", *said)
            self.assertAlmostEqual(analysed["rate_hz"], 200, delta=1e-6)

    def test_a_choice_that_is_certain_is_made(self):
        rates = self.rates(400)
        turned = numpy.cumsum(abs(rates))
        path = self.write("angle.csv", "".join(f"{k * 0.005:.3f};{a:.6f}\n" for k, a in enumerate(turned)))
        _, analysed = self.mean(path, "--map", "axis=2", "--map", "holds=angle", "--map", "unit=arcsec", "--map", "time_unit=s")
        self.assertAlmostEqual(analysed["rate_hz"], 200, delta=1e-6)

    def test_of_arrays_too(self):
        buffer = io.BytesIO()
        numpy.save(buffer, numpy.column_stack([numpy.arange(400.0), numpy.arange(400) / 200, self.rates(400)]))
        path = self.write("a.npy", buffer.getvalue())
        said = ["--map", "axis=3", "--map", "holds=rate", "--map", "unit=deg/s", "--map", "time_unit=s"]
        self.refuse(2, "import", path, "--out", self.folder / "o.csv", *said, says=("time=1|2",))
        _, analysed = self.mean(path, *said, "--map", "time=2")
        self.assertAlmostEqual(analysed["rate_hz"], 200, delta=1e-6)
