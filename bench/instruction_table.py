"""What the counts of instructions have in common: the modules, what is kept of many half-periods, and the comparison."""

import collections
import statistics
from pathlib import Path

TOLERANCE = 0.05
TOLERANCE_OTHER_COMPILER = 0.5

# Sources that are part of a module of another name. What several modules share is charged to the function that uses it.
PART_OF = {
    "gap_bridge_config": "gap_bridge",
    "gap_interpolation": "gap_bridge",
    "polynomial_fit": "gap_bridge",
    "gyro_observation": "gyro_control",
    "bridge_scores": "motion_learning",
    "motion_moments": "motion_learning",
    "cholesky": "optimal_bridge",
    "gap_estimate": "optimal_bridge",
    "gap_points": "optimal_bridge",
    "few_ticks": "optimal_bridge",
    "gap_rounding": "optimal_bridge",
    "rounding_law": "optimal_bridge",
    "gap_known": "counted_stretch",
    "gap_known_estimate": "counted_stretch",
    "joint_relock": "optimal_bridge",
    "motion_covariance": "optimal_bridge",
    "stage_model": "perimeter_loop",
    "maths": "relock_drift",
    "relock_chain": "relock_profile",
    "relock_light": "relock_profile",
    "relock_moment": "relock_profile",
}
MODULES = [
    "sync_detector", "perimeter_loop", "half_wave", "stroke_model", "mode_switch", "switch_schedule", "bias_commutator",
    "edge_dither", "frame_order", "bias_monitor", "coil_monitor", "counter_monitor", "reading_monitor", "light_monitor", "detuning_monitor", "health",
    "gyro_control", "relock_drift", "relock_profile", "edge_shift", "gap_bridge", "motion_moments",
    "bridge_scores", "motion_learning", "optimal_bridge", "counted_stretch", "joint_relock", "angle", "gyro_compensation",
]
CONTROL = MODULES[:MODULES.index("relock_drift")]
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


def show(table):
    print(f"{table['halves']} half-periods, {table['compiler']}\n")
    print(f"{'module':<32}{'typical':>8}{'most':>8}  most in the script")
    for name, row in table["modules"].items():
        print(f"{name:<32}{row['typical']:>8}{row['most']:>8}  {row['most_in']}")
    print(f"\n{'script: control + compensation':<32}{'typical':>8}{'most':>8}")
    for name, row in table["scripts"].items():
        print(f"{name:<32}{row['typical']:>8}{row['most']:>8}")


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
