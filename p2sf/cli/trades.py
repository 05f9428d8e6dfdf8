"""`p2sf tradeoff --complete` and `--sampling`: every representation of all PSFs, and the paper's two sample counts."""

from pathlib import Path
from typing import Any, BinaryIO

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import check_output
from p2sf.cli.screen import print_json, print_table
from p2sf.errors import RequestError
from p2sf.files.writing import write_beside, write_json
from p2sf.messages import Alternatives
from p2sf.studies import trade_fronts
from p2sf.studies.complete_trade import LensTrade, record, shipped_trades, text_of

WRITTEN = (".json", ".csv", ".png")


def complete(name: str | None, output: Path | None, as_json: bool) -> None:
    """Print, write or draw what all representations of one shipped lens, or of each, were measured to cost."""
    check_output(output, WRITTEN, name)
    trades = _kept(name)
    if output is not None:
        _write(output, trades)
    if as_json:
        return print_json(record(trades) | {"says": trade_fronts.findings(trades)})
    for trade in trades if name is not None else ():
        _print_lens(trade)
    head, *rows = trade_fronts.summary(trades)
    print_table(f"Typical of {len(trades)} lenses: the best that keeps the bytes", head, rows)
    return None


def _kept(name: str | None) -> list[LensTrade]:
    """Return the kept trades of one lens, or of all; RequestError for a lens that has none."""
    kept = shipped_trades()
    if name is None:
        return list(kept.values())
    if name not in kept:
        raise RequestError(
            "{name} is none of the lenses whose complete trade is kept; choose {choices}",
            name=name,
            choices=Alternatives(kept),
        )
    return [kept[name]]


def _print_lens(trade: LensTrade) -> None:
    place = trade_fronts.place_words(trade)
    print_table(f"{trade.title}: {place}", trade_fronts.COLUMNS, trade_fronts.lines(trade.rows))
    for field, rows in trade.singles:
        print_table(f"\nOne PSF alone, at {field:.3g}°", trade_fronts.COLUMNS, trade_fronts.lines(rows))
    print(f"\nExact rays differ from the Huygens sum by 1 − R² = {trade.truth_error:.1e} at most.")
    for family, why in trade.refused:
        print(f"{family}: {why}")
    print(f"{trade.seconds:.0f} s of CPU time\n")


def _write(output: Path, trades: list[LensTrade]) -> None:
    def write(handle: BinaryIO) -> None:
        match output.suffix.lower():
            case ".json":
                handle.write(text_of(trades).encode())
            case ".csv":
                handle.write(_csv(trades).encode())
            case ".png":
                from p2sf.studies.trade_plots import draw_trades

                draw_trades(handle, trades)

    write_beside(output, write)


def _csv(trades: list[LensTrade]) -> str:
    lines: list[tuple[str, ...]] = [("lens", *trade_fronts.COLUMNS)]
    lines += [(trade.lens, *line) for trade in trades for line in trade_fronts.lines(trade.rows)]
    return "".join(";".join(line) + "\n" for line in lines)


def sampling(name: str | None, output: Path | None, as_json: bool) -> None:
    """Map the error of the paper's FFT over NPUPIL and NPSF, at 10° of one lens, the paper's if none is named."""
    from p2sf.studies.sampling import draw_sampling, sampling_map

    check_output(output, (".json", ".png"), name)
    found = sampling_map() if name is None else sampling_map(open_lens(name))
    values: dict[str, Any] = vars(found)
    if output is not None and output.suffix.lower() == ".png":
        write_beside(output, lambda handle: draw_sampling(handle, found))
    elif output is not None:
        write_json(output, values)
    if as_json:
        return print_json(values)
    place = f"{found.lens}, {found.field_deg:g}°, {found.wavelength_nm:g} nm, window {found.window_um:g} µm"
    rows = [
        (size, *(f"{x:.1g}" if x == x else "–" for x in row))
        for size, row in zip(found.npupil, found.errors, strict=True)
    ]
    print_table(f"{place}: relative L2 error of the FFT", ("NPUPIL \\ NPSF", *map(str, found.npsf)), rows)
    for quality, taken in found.rule.items():
        print(
            f"the program takes ({quality}): "
            + ", ".join(f"{n}: {m or 'refused'}" for n, m in zip(found.npsf, taken, strict=True))
        )
    return print(
        f"samples λ/(4 NA) apart: {found.critical:.1f}; the paper: NPSF {found.paper[0]}, NPUPIL ≥ {found.paper[1]}"
    )


def check_combination(complete: bool, sampling: bool, name: str | None) -> None:
    """Raise RequestError for flags that do not go together."""
    if complete and sampling:
        raise RequestError("--complete and --sampling are two studies; ask for one of them")
    if name is None and not (complete or sampling):
        raise RequestError("no lens is named; give one, or --complete for all shipped lenses")
