"""Fuzz every reader and the command line's numbers, guided by coverage (needs ``pip install atheris``).

``python -m tests.fuzz.run [seconds in total] [target …]``; 900 s by default, shared by the targets. Each runs in a
process of its own with a limit on each input's seconds (`targets.SECONDS`) and 1 GiB of memory. What breaks is left in
tests/fuzz/corpus/<target>-<hash>, where ``tests/fuzz/test_fuzz.py`` finds it from then on; all that the process said,
and the last input it was given, even where it died without a word, in tests/fuzz/broken/.
"""

import hashlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.fuzz.seeds import seeds
from tests.fuzz.targets import LAST, SECONDS, TARGETS

CORPUS, BROKEN = Path(__file__).parent / "corpus", Path(__file__).parent / "broken"
REASON = re.compile(r"^.*(?:ERROR: libFuzzer|Uncaught Python exception|MemoryError|Killed).*$", re.MULTILINE)
LONGEST = {
    "command_line": 200,
    "toml": 6000,
    "lens_file": 6000,
    "glass_catalogue": 4000,
    "database": 60_000,
    "psf_file": 8000,
    "picture": 8000,
    "scene": 2000,
    "state": 6000,
    "lesson": 4000,
}
MEGABYTES = 1024


def fuzz(target: str, seconds: float) -> bool:
    """Run one target in a process of its own and print its counts; return whether nothing broke."""
    with tempfile.TemporaryDirectory() as folder:
        inputs = Path(folder) / "inputs"
        for number, seed in enumerate(seeds(target)):
            keep(inputs, str(number), seed)
        # The first start compiles and imports, hence the slower first input; libFuzzer's own limit is the hang's.
        command = [sys.executable, "-m", "tests.fuzz.job", target, str(inputs)]
        limits = [f"-max_total_time={seconds:.0f}", f"-timeout={SECONDS[target]}", f"-rss_limit_mb={MEGABYTES}"]
        extra = [f"-max_len={LONGEST[target]}", f"-artifact_prefix={folder}/found-", "-print_final_stats=1"]
        result = subprocess.run([*command, *limits, *extra], capture_output=True, text=True, errors="replace")
        artifacts = [found.read_bytes() for found in Path(folder).glob("found-*")]
        last = Path(folder) / LAST
        tried = last.read_bytes() if last.exists() else b""
    for data in artifacts:
        keep(CORPUS, target, data)
    if result.returncode:
        log = f"exit code {result.returncode}, {len(artifacts)} artifacts\n{result.stdout}\n{result.stderr}"
        keep(BROKEN, target, tried).with_suffix(".log").write_text(log, encoding="utf-8")
    report(target, seconds, result.stderr, result.returncode)
    return result.returncode == 0


def keep(folder: Path, target: str, data: bytes) -> Path:
    """Write an input under its target and hash; return its path."""
    folder.mkdir(exist_ok=True)
    path = folder / f"{target}-{hashlib.sha256(data).hexdigest()[:12]}"
    path.write_bytes(data)
    return path


def report(target: str, seconds: float, log: str, code: int) -> None:
    """Print inputs tried, seconds, coverage edges and peak memory, and the end of a failure."""
    tried = re.findall(r"stat::number_of_executed_units:\s*(\d+)", log) or re.findall(r"#(\d+)", log)[-1:]
    edges = re.findall(r"cov: (\d+)", log)[-1:]
    memory = re.findall(r"stat::peak_rss_mb:\s*(\d+)", log)
    figures = (f"{x[0]} {unit}" for x, unit in ((tried, "inputs"), (edges, "edges"), (memory, "MB")) if x)
    verdict = "nothing broke" if code == 0 else f"BROKE, exit code {code}"
    print(f"{target}: {seconds:.0f} s, {', '.join(figures)}, {verdict}", flush=True)
    if code:
        print("\n".join(REASON.findall(log)) or "no reason was given", log[-3000:], sep="\n", flush=True)


def main() -> int:
    total = float(sys.argv[1]) if len(sys.argv) > 1 else 900.0
    names = sys.argv[2:] or list(TARGETS)
    return 0 if all([fuzz(name, total / len(names)) for name in names]) else 1


if __name__ == "__main__":
    sys.exit(main())
