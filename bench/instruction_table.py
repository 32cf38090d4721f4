"""What the counts of instructions have in common: the modules, what is kept of many half-periods, the comparison, the command line."""

import argparse
import collections
import json
import re
import statistics
import subprocess
import sys
from pathlib import Path

PROGRAM = Path(sys.argv[0]).name
MAX_WORST = 30000  # instructions in the worst half-period

ROW = 150  # columns

TOLERANCE = 0.05
TOLERANCE_OTHER_COMPILER = 0.5

# Sources that are part of a module of another name. What several modules share is charged to the function that uses it.
PART_OF = {
    **dict.fromkeys(["gap_bridge_config", "gap_bridge_state", "gap_interpolation", "polynomial_fit", "gap_switch",
                     "switch_job", "handover"], "gap_bridge"),
    **dict.fromkeys(["triangle", "learnt_motion", "light_spline", "switch_estimate", "switch_window", "bank_kernel",
                     "walk_kernel", "window_covariance"], "estimate"),
    **dict.fromkeys(["gyro_observation", "monitors", "health"], "gyro_control"),
    "ellipse_correction": "fringe_readout",
    "border": "gyro_compensation",
    "compensation_constants": "relock_drift",
    "gap_known": "counted_stretch",
    "stage_model": "perimeter_loop",
    **dict.fromkeys(["maths_kernels", "exponential", "hyperbolic_tangent", "hypot", "inverse", "logarithm", "reduction",
                     "trigonometric", "turns_of"], "relock_drift"),
    "as_double": "relock_drift",
    "gyro_control_state": "gyro_control",
}
MODULES = [
    "sync_detector", "perimeter_loop", "half_wave", "mode_switch", "switch_schedule", "bias_commutator",
    "edge_dither", "frame_order", "bias_monitor", "coil_monitor", "counter_monitor", "reading_monitor", "light_balance", "light_monitor", "detuning_monitor", "fringe_readout",
    "gyro_control", "relock_drift", "switch_light", "edge_shift", "lock_in", "gap_bridge", "estimate", "counted_stretch", "angle",
    "gyro_compensation",
]
WHOLE = "whole half-period"
USUAL = "steady, 16 samples"


def module_of(path, modules=MODULES, part_of=PART_OF):
    """The module that a source file belongs to, or None."""
    stem = Path(path).stem
    stem = part_of.get(stem, stem)
    return stem if stem in modules else None


def modules_table(halves, names):
    """Typical and most of each module, of halves that are (script, half, counts)."""
    usual = [c for script, _, c in halves if script == USUAL]
    modules = {}
    for name in names:
        # Typical: of the halves of a steady gyro, or of any, in which the module works at all.
        working = [c[name] for c in usual if c[name]] or [c[name] for _, _, c in halves if c[name]]
        if not working:
            continue
        most = max(halves, key=lambda h: h[2][name])
        modules[name] = {"typical": round(statistics.median(working)), "most": most[2][name], "most_in": most[0]}
    return modules


def scripts_table(halves):
    """Typical and most of the whole half-period, script by script."""
    scripts = collections.OrderedDict()
    for script, _, counts in halves:
        scripts.setdefault(script, []).append(counts[WHOLE])
    return {s: {"typical": round(statistics.median(v)), "most": max(v)} for s, v in scripts.items()}


def worst_of(halves, names):
    script, half, counts = max(halves, key=lambda h: h[2][WHOLE])
    return {"script": script, "half": half, "instructions": counts[WHOLE],
            "by_module": {m: counts[m] for m in names if m != WHOLE and counts[m]}}


def figures(table):
    """Every figure of the modules and scripts that is compared, by name."""
    flat = {}
    for group in ("modules", "scripts"):
        for name, row in table[group].items():
            flat[f"{name}, typical"] = row["typical"]
            flat[f"{name}, most"] = row["most"]
    return flat


def differences(new, old, same_compiler):
    """One line for each figure, by name, that is not what the kept table says."""
    if not same_compiler:
        return [f"{name}: {new[name]}, table {old[name]}" for name in old
                if name in new and new[name] > old[name] * (1 + TOLERANCE_OTHER_COMPILER) + 20]
    found = [f"{name}: in one of the two only" for name in sorted(set(new) ^ set(old))]
    for name in sorted(set(new) & set(old)):
        if abs(new[name] - old[name]) > max(2, TOLERANCE * old[name]):
            found.append(f"{name}: {new[name]}, table {old[name]}")
    return found


def note_on_compilers(now, kept):
    """Whether both tables are of one compiler; says so where not."""
    if now["compiler"] == kept["compiler"]:
        return True
    print(f"note: the table is of {kept['compiler']}, this is {now['compiler']}: "
          f"only a growth by more than {TOLERANCE_OTHER_COMPILER:.0%} counts")
    return False


def tool(*command, text=None):
    """What a command prints."""
    run = subprocess.run([str(word) for word in command], input=text, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise SystemExit(f"{PROGRAM}: {' '.join(map(str, command))}: exit {run.returncode}\n{run.stderr}")
    return run.stdout


def lines_of(name, value, indent=""):
    """A value of the kept table as JSON: what has its place on one line is a row of it."""
    row = f"{indent}{name}{json.dumps(value)}"
    if not isinstance(value, dict) or len(row) <= ROW and not any(isinstance(each, dict) for each in value.values()):
        return [row]
    parts = [lines_of(f"{json.dumps(key)}: ", each, indent + " ") for key, each in value.items()]
    inside = [line for part in parts for line in (*part[:-1], part[-1] + ",")]
    return [f"{indent}{name}{{", *inside[:-1], inside[-1][:-1], f"{indent}}}"]


def write_table(path, table):
    path.write_text("\n".join(lines_of("", table)) + "\n", encoding="utf-8")


def command_line(doc):
    """A parser that knows one of --check and --renew."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    action = parser.add_mutually_exclusive_group()
    for name in ("--check", "--renew"):
        action.add_argument(name, action="store_true")
    return parser


def report(complaints):
    """Prints them; the exit status."""
    for line in complaints:
        print(f"{PROGRAM}: {re.sub(' +', ' ', line)}", file=sys.stderr)
    if complaints:
        print(f"{PROGRAM}: if that is meant, bench/{PROGRAM} --renew", file=sys.stderr)
    return 1 if complaints else 0
