"""A plan as text, in English, and as JSON: its decisions, predicted error and cost."""

from p2sf.scene.planning.plan import Plan

MEBIBYTE = 2.0**20
EDGES = (
    "This is the error of kernels. Within four pixels of an edge of depth, occlusion adds up to 0.01 of white (RMS), "
    "for a background that goes on behind it as its nearest pixels."
)


def plan_rows(planned: Plan) -> list[tuple[str, str, str, str]]:
    """Return (what, choice, error, why) of every decision."""
    return [(str(d.what), str(d.choice), f"{d.error:.2g}", str(d.why)) for d in planned.decisions]


def plan_sentences(planned: Plan) -> list[str]:
    """Return sentences on the plan's predicted error and cost, and on the cost of the full grid."""
    tolerance, cost, naive = planned.allowed_error, planned.cost, planned.naive
    verdict = "keeps" if planned.meets else "does NOT keep"
    edges = [EDGES] if planned.scene.near_mm < planned.scene.far_mm else []
    return [
        f"The predicted relative error of {planned.predicted_error:.3g} {verdict} the tolerance of {tolerance:.3g}"
        f"{_as_asked(planned)}.",
        *edges,
        f"Kernels take {cost.kernel_seconds:.2g} s of one core, a picture {cost.picture_seconds:.2g} s more, and "
        f"{cost.memory_bytes / MEBIBYTE:.0f} MiB.",
        "The full grid for the same error (one method everywhere, every wavelength and fringe, own rays for each PSF "
        f"in the window of the widest blur, nothing from symmetry) takes {naive.kernel_seconds:.2g} s for its kernels, "
        f"{naive.kernel_seconds / cost.kernel_seconds:.1f} times "
        "as long.",
    ]


def _as_asked(planned: Plan) -> str:
    """Return the error and the tolerance in the measure of the scene, if that is another."""
    scene = planned.scene
    found = scene.measured(planned.predicted_error, planned.norm)
    words = {
        "mtf": "an MTF error of {0:.2g}, at most {1:g}",
        "psnr": "{0:.1f} dB, at least {1:g}",
        "r2": "R² {0:.4f}, at least {1:g}",
        "hdr": "halos of bright light by kernels of full size, to {1:g} of their means",
    }
    return f": {words[scene.measure].format(found, scene.limit)}" if scene.measure in words else ""


def plan_facts(planned: Plan) -> dict:
    """Return the plan as JSON values."""
    return {
        "aim": planned.lens.aim,
        "tolerance": planned.allowed_error,
        "asked": {"measure": planned.scene.measure, "tolerance": planned.scene.limit},
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
