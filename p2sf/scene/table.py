"""A plan as text, in English, and as JSON: its decisions, predicted error and cost."""

from p2sf.scene.plan import Plan

MEBIBYTE = 2.0**20


def plan_rows(planned: Plan) -> list[tuple[str, str, str, str]]:
    """Return (what, choice, error, why) of every decision."""
    return [(str(d.what), str(d.choice), f"{d.error:.2g}", str(d.why)) for d in planned.decisions]


def plan_sentences(planned: Plan) -> list[str]:
    """Return sentences on the plan's predicted error and cost, and on the cost of the full grid."""
    tolerance, cost, naive = planned.scene.relative_tolerance, planned.cost, planned.naive
    verdict = "keeps" if planned.meets else "does NOT keep"
    return [
        f"The predicted relative error of {planned.predicted_error:.3g} {verdict} the tolerance of {tolerance:.3g}.",
        f"Kernels take {cost.kernel_seconds:.2g} s of one core, a picture {cost.picture_seconds:.2g} s more, and "
        f"{cost.memory_bytes / MEBIBYTE:.0f} MiB.",
        "The full grid for the same error (one method everywhere, every wavelength and fringe, own rays for each PSF "
        f"in the window of the widest blur, nothing from symmetry) takes {naive.kernel_seconds:.2g} s for its kernels, "
        f"{naive.kernel_seconds / cost.kernel_seconds:.1f} times "
        "as long.",
    ]


def plan_facts(planned: Plan) -> dict:
    """Return the plan as JSON carries it."""
    return {
        "aim": planned.lens.aim,
        "tolerance": planned.scene.relative_tolerance,
        "predicted_error": planned.predicted_error,
        "meets": planned.meets,
        "nodes": {"rows": planned.counts[0], "columns": planned.counts[1], "depths": len(planned.vergences)},
        "wavelengths_nm": [[1000 * w for w in colour.wavelengths_um] for colour in planned.colours],
        "decisions": [
            {"what": str(d.what), "choice": str(d.choice), "why": str(d.why), "error": d.error}
            for d in planned.decisions
        ],
        "cost": vars(planned.cost),
        "full_grid_cost": vars(planned.naive),
    }
