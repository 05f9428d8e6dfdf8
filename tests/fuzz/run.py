"""Fuzz every reader and the command line's numbers, guided by coverage (needs ``pip install atheris``).

``python -m tests.fuzz.run [seconds in total] [target …]``; 900 s by default, shared by the targets. Each runs in a
process of its own with a limit on each input's seconds (`targets.SECONDS`) and 1 GiB of memory. What breaks is left in
tests/fuzz/corpus/<target>-<hash>, where ``tests/fuzz/test_fuzz.py`` finds it from then on.
"""

import hashlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.fuzz.seeds import seeds
from tests.fuzz.targets import SECONDS, TARGETS

CORPUS = Path(__file__).parent / "corpus"
LONGEST = {"command_line": 200, "toml": 6000, "lens_file": 6000, "glass_catalogue": 4000, "database": 60_000}
MEGABYTES = 1024


def fuzz(target: str, seconds: float) -> bool:
    """Run one target in a process of its own and print its counts; return whether nothing broke."""
    with tempfile.TemporaryDirectory() as folder:
        for number, seed in enumerate(seeds(target)):
            (Path(folder) / str(number)).write_bytes(seed)
        # The first start compiles and imports, hence the slower first input; libFuzzer's own limit is the hang's.
        command = [sys.executable, "-m", "tests.fuzz.job", target, folder]
        limits = [f"-max_total_time={seconds:.0f}", f"-timeout={SECONDS[target]}", f"-rss_limit_mb={MEGABYTES}"]
        extra = [f"-max_len={LONGEST[target]}", f"-artifact_prefix={folder}/found-", "-print_final_stats=1"]
        result = subprocess.run([*command, *limits, *extra], capture_output=True, text=True, errors="replace")
        for found in Path(folder).glob("found-*"):
            keep(target, found.read_bytes())
    report(target, seconds, result.stderr, result.returncode)
    return result.returncode == 0


def keep(target: str, data: bytes) -> None:
    name = hashlib.sha256(data).hexdigest()[:12]
    (CORPUS / f"{target}-{name}").write_bytes(data)


def report(target: str, seconds: float, log: str, code: int) -> None:
    """Print inputs tried, seconds, coverage edges and peak memory, and the end of a failure."""
    tried = re.findall(r"stat::number_of_executed_units:\s*(\d+)", log) or re.findall(r"#(\d+)", log)[-1:]
    edges = re.findall(r"cov: (\d+)", log)[-1:]
    memory = re.findall(r"stat::peak_rss_mb:\s*(\d+)", log)
    figures = (f"{x[0]} {unit}" for x, unit in ((tried, "inputs"), (edges, "edges"), (memory, "MB")) if x)
    verdict = "nothing broke" if code == 0 else f"BROKE, exit code {code}"
    print(f"{target}: {seconds:.0f} s, {', '.join(figures)}, {verdict}", flush=True)
    if code:
        print(log[-3000:], flush=True)


def main() -> int:
    total = float(sys.argv[1]) if len(sys.argv) > 1 else 900.0
    names = sys.argv[2:] or list(TARGETS)
    return 0 if all([fuzz(name, total / len(names)) for name in names]) else 1


if __name__ == "__main__":
    sys.exit(main())
