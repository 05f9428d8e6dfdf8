"""`pytest tests/extremes --report` prints quantity × regime → worst error in units of its conditioning."""

import pytest

ROWS: dict[tuple[str, str], float] = {}


def pytest_addoption(parser):
    parser.addoption("--report", action="store_true", help="print the table quantity × regime → worst error / κ")


@pytest.fixture
def record():
    """Return a function (quantity, regime, error in κ) that keeps the worst of each."""

    def keep(quantity: str, regime: str, error: float) -> None:
        ROWS[quantity, regime] = max(error, ROWS.get((quantity, regime), 0.0))

    return keep


def pytest_terminal_summary(terminalreporter, config):
    if not config.getoption("--report", default=False) or not ROWS:
        return
    terminalreporter.section("worst |error| in units of κ")
    for line in table(ROWS):
        terminalreporter.write_line(line)


def table(rows) -> list[str]:
    """Return the rows as a Markdown table, regimes down, quantities across."""
    quantities = list(dict.fromkeys(quantity for quantity, _ in rows))
    regimes = list(dict.fromkeys(regime for _, regime in rows))
    lines = ["| regime | " + " | ".join(quantities) + " |", "|---" * (len(quantities) + 1) + "|"]
    for regime in regimes:
        cells = (f"{rows[q, regime]:.0e}" if (q, regime) in rows else "–" for q in quantities)
        lines.append(f"| {regime} | " + " | ".join(cells) + " |")
    return lines
