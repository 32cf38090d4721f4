"""What `cmake --install` puts into a prefix, used as a stranger's project would use it."""

import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
ZLG = BUILD / "bin" / "zlg"
FIVE = ["half", "bias_sign", "mode", "counts", "loop_closed"]


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def rows(path):
    """The lines of a CSV log as dictionaries, after those of its head."""
    lines = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="zlg-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", "development")

    def built(self, source):
        """The program of a project that finds zlg below the prefix alone."""
        build = self.folder / f"build-{source.name}"
        run("cmake", "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        return build / source.name

    def test_the_core_in_a_strangers_program_makes_the_programs_angles(self):
        raw, five, angles = (self.folder / name for name in ("raw.csv", "five.csv", "angles.csv"))
        run(ZLG, "simulate", "--duration", 30, "--set", "switching.interval_s=5", "--out", raw)
        halves = [",".join(row[name] for name in FIVE) for row in rows(raw)]
        head = ["# gyro.tick_s = 0.005", "# gyro.scale_arcsec = 3.263", ",".join(FIVE)]
        five.write_text("\n".join(head + halves) + "\n")
        run(ZLG, "process", five, "--out", angles, "--set", "compensation.relock=none")
        program = self.built(ROOT / "examples" / "embed_core")
        halves = "\n".join(halves).replace(",", " ")
        ticks = run(program, input=halves).splitlines()
        expected = rows(angles)
        self.assertEqual((len(ticks), len(expected)), (6000, 6000))
        for line, row in zip(ticks, expected):
            tick, dtheta, sigma, flags = line.split()
            self.assertEqual((tick, float(dtheta), float(sigma), flags),
                             (row["tick"], float(row["dtheta_final_arcsec"]), float(row["sigma_arcsec"]), row["flags"]))
        self.assertEqual(sum(int(row["flags"]) & 4 for row in expected), 4 * 5 * 3)  # 5 gaps of 3 ticks, interpolated
        wrong = subprocess.run([program], input="0 1 1 150 1\n1 -1 1 abc 1\n", capture_output=True, text=True, check=False)
        self.assertEqual((wrong.returncode, wrong.stderr), (1, "embed_core: row 2: allowed are five whole numbers\n"))

        self.the_gyros_processor_says(ticks, halves)

    def the_gyros_processor_says(self, ticks, halves):
        """The same program on a Cortex-M7, where its compiler and an emulator are there."""
        if not (BUILD / "arm" / "cmake_install.cmake").is_file() or not shutil.which("qemu-system-arm"):
            return
        core, build = self.folder / "arm-core", self.folder / "arm-build"
        run("cmake", "--install", BUILD / "arm", "--prefix", core)
        run("cmake", "-S", ROOT / "examples" / "embed_core", "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/cmake/arm-none-eabi.cmake", f"-DCMAKE_PREFIX_PATH={core}")
        run("cmake", "--build", build)
        said = run("qemu-system-arm", "-M", "mps2-an500", "-display", "none", "-monitor", "none", "-serial", "null",
                   "-semihosting-config", "enable=on,target=native",
                   "-device", f"loader,file={build}/embed_core,cpu-num=0", input=halves, timeout=120)
        self.assertEqual(said.splitlines(), ticks)

    def test_a_gyro_of_ones_own_is_switched_and_compensated(self):
        raw, angles = self.folder / "own.csv", self.folder / "own_angles.csv"
        said = run(self.built(ROOT / "examples" / "own_gyro"), 60, 100, raw).split()
        run(ZLG, "process", raw, "--out", angles)
        turned = sum(float(row["dtheta_final_arcsec"]) for row in rows(angles))
        self.assertAlmostEqual(float(said[0]), turned, delta=1e-5)
        # As long in one mode as in the other, so that its field adds 1 arcsec/s nowhere: rounding and eleven switches are left.
        self.assertEqual(said[-2:], ["11", "switches"])
        self.assertLess(abs(turned - 6000), 3 * 3.263)

    @unittest.skipUnless(shutil.which("pkg-config"), "pkg-config is not installed")
    def test_pkg_config_names_the_core(self):
        env = {**os.environ, "PKG_CONFIG_PATH": str(self.prefix / "share" / "pkgconfig")}
        said = run("pkg-config", "--cflags", "--libs", "zlg-core", env=env).split()
        self.assertIn("-lzlg_core", said)
        folder = next(part[2:] for part in said if part.startswith("-I"))
        self.assertTrue((Path(folder) / "zlg" / "core" / "records.hpp").is_file())

    def test_no_bytecode_of_one_compiler_is_installed(self):
        sections = run("readelf", "-S", "-W", self.prefix / "lib" / "libzlg_core.a")
        self.assertIn(".text", sections)
        self.assertNotIn(".gnu.lto", sections)

    def test_the_program_looks_for_libraries_in_the_system_alone(self):
        run("cmake", "--install", BUILD, "--prefix", self.prefix, "--component", "program")
        said = run("readelf", "-d", "-W", self.prefix / "bin" / "zlg")
        self.assertIn("(NEEDED)", said)
        self.assertNotRegex(said, r"\((RPATH|RUNPATH)\)")

    def test_a_component_that_is_none_is_refused(self):
        source = self.folder / "wrong"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(wrong CXX)\nfind_package(zlg REQUIRED COMPONENTS core cor)\n")
        done = subprocess.run(["cmake", "-S", source, "-B", source / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}"],
                              capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"no component 'cor'; allowed\s+are:\s+core")


class Subdirectory(unittest.TestCase):
    def test_within_another_project_there_are_the_libraries_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder)
            (source / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(outer CXX)\n"
                f'add_subdirectory("{ROOT}" zlg EXCLUDE_FROM_ALL)\n'
                "add_executable(outer main.cpp)\ntarget_link_libraries(outer PRIVATE zlg::core)\n"
                "foreach(target zlg zlg_study zlg_bench zlg_core_tests)\nif(TARGET ${target})\n"
                'message(SEND_ERROR "has ${target}")\nendif()\nendforeach()\n')
            (source / "main.cpp").write_text("#include <zlg/core/records.hpp>\nint main() { return zlg::core::HalfRecord{} == zlg::core::HalfRecord{} ? 0 : 1; }\n")
            run("cmake", "-S", source, "-B", source / "build", "-G", "Ninja")
            commands = run("ninja", "-C", source / "build", "-t", "commands", "CMakeFiles/outer.dir/main.cpp.o")
            self.assertIn("-std=c++20", commands.replace("gnu++20", "c++20"))
            self.assertNotIn("-Werror", run("ninja", "-C", source / "build", "-t", "commands", "zlg_core"))


@unittest.skipUnless(shutil.which("cpack") and shutil.which("dpkg-deb"), "there are no tools of Debian packages")
class Package(unittest.TestCase):
    """Of the documents of the Debian package: packing the program as well would want its build."""

    def packed(self):
        folder = Path(tempfile.mkdtemp(prefix="zlg-package-"))
        self.addCleanup(shutil.rmtree, folder)
        run("cpack", "-G", "DEB", "-D", "CPACK_COMPONENTS_ALL=doc", "-B", folder, cwd=BUILD, env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})
        return next(folder.glob("*.deb"))

    def test_what_is_packed_twice_is_equal(self):
        first = self.packed().read_bytes()
        time.sleep(1.1)  # times of files are whole seconds
        (BUILD / "package" / "changelog").touch()
        self.assertEqual(first, self.packed().read_bytes())

    def test_it_holds_every_file_that_its_documents_lead_to(self):
        folder = Path(tempfile.mkdtemp(prefix="zlg-unpacked-"))
        self.addCleanup(shutil.rmtree, folder)
        run("dpkg-deb", "--extract", self.packed(), folder)
        root = folder / "usr" / "share" / "doc" / "zlg"
        missing = set()
        for page in root.rglob("*.md"):
            text = page.read_text()
            links = [page.parent / link for link in re.findall(r"\]\((?!https?:)([^)#:\s]+)", text)]
            named = [root / name for name in re.findall(r"examples/\w+(?:\.\w+)?", text)]
            missing |= {str(path.resolve().relative_to(root.resolve())) for path in links + named if not path.exists()}
        # In a Debian package the licence stands in the file copyright.
        self.assertEqual(missing, {"LICENSE"})
