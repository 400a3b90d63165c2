#!/usr/bin/env python3
"""Runs the parts of ./test: see ./test --help, and tests/parts.csv for what each part is for.

A part is a build of one target with one set of flags, whose tests run here or under an emulator, or a command over such
builds. The parts are tests of an outer ctest, which runs them beside each other, longest first; each calls this file again
(`parts.py run PART`), builds what it needs in build/PART and notes how long that took.
"""
import argparse
import csv
import fnmatch
import hashlib
import json
import os
import re
import resource
import shlex
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MATRIX = ROOT / "build" / "matrix"
PROGRESS = MATRIX / "progress"
PROCESSORS = len(os.sched_getaffinity(0))
MARGIN = 1.6  # a part may take so many times its budget, for machines differ and share their processors


def table(path):
    with open(ROOT / path, newline="") as file:
        return list(csv.DictReader(file))


PARTS = {row["part"]: row for row in table("tests/parts.csv")}
TARGETS = {row["name"]: row for row in table("toolchains/targets.csv")}
INPUTS = {row["inputs"]: row for row in table("tests/inputs.csv")}


def chosen(text):
    """A column of tests/parts.csv: what is in parentheses counts only with --full."""
    return re.sub(r"[()]" if os.environ.get("DETENT_FULL") else r"\([^)]*\) *", "", text).strip()


def configs_of(part):
    return chosen(part["configs"]) or TARGETS[part["target"]]["configs"]


def budget(part):
    """Seconds of a processor: to build it from nothing, and to run its tests."""
    return int(part["build"]), int(part["test"])


# What a part depends on


def source_files():
    """What git knows or would take; where it can't tell, all that is not built."""
    try:
        command = ["git", "-c", f"safe.directory={ROOT}", "ls-files", "-co", "--exclude-standard", "-z"]
        names = subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout.decode().split("\0")
    except (OSError, subprocess.CalledProcessError):
        names = [str(path.relative_to(ROOT)) for path in ROOT.rglob("*") if path.relative_to(ROOT).parts[0] not in ("build", ".git")]
    return sorted(name for name in names if name and (ROOT / name).is_file())


def inputs_of(part, files):
    row = INPUTS[part["inputs"]]
    wanted, unwanted = row["files"].split(), row["but"].split()
    matches = lambda name, patterns: any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
    return [name for name in files if matches(name, wanted) and not matches(name, unwanted)]


def digest_of(part, files, cache={}):
    """Of everything that can change what the part says: its row, --full, its files, and the versions of its tools."""
    total = hashlib.sha256(json.dumps([part, "DETENT_FULL" in os.environ]).encode())
    packages = set("cmake ninja-build googletest".split())
    for name in [part["target"]] + part["needs"].split():
        packages.update(TARGETS.get(name, {"packages": ""})["packages"].split())
    total.update(subprocess.run(["dpkg-query", "-W", *sorted(packages)], capture_output=True).stdout)
    if "native" in part["flags"]:
        total.update("".join(line for line in open("/proc/cpuinfo") if line.startswith("flags")).encode())
    for name in inputs_of(part, files):
        if name not in cache:
            cache[name] = hashlib.sha256((ROOT / name).read_bytes()).hexdigest()
        total.update(f"{name} {cache[name]}\n".encode())
    return total.hexdigest()


# Running a part


def note(kind, name, **more):
    with open(PROGRESS, "a") as file:
        file.write(json.dumps({"kind": kind, "part": name, **more}) + "\n")


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def cached_tests(build, passed):
    """The tests of a build that need not run again: their programs and data are those with which they passed. `passed`: the
    digests of then. Returns the numbers to run, or None for all, and the digests of now."""
    listed = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, check=True).stdout)
    known, now, run = {}, {}, []
    data = hashlib.sha256(b"full" if "DETENT_FULL" in os.environ else b"")
    for name in source_files():
        if not name.endswith((".cpp", ".h", ".md")):
            data.update(name.encode() + hashlib.sha256((ROOT / name).read_bytes()).digest())
    for number, test in enumerate(listed["tests"], 1):
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        programs = [word for word in test.get("command", []) if word.startswith(str(build)) and os.path.isfile(word)]
        programs += properties.get("REQUIRED_FILES", [])
        total = hashlib.sha256(data.digest() + json.dumps([test.get("command"), properties]).encode())
        for path in programs:
            if path not in known and os.path.isfile(path):
                known[path] = hashlib.sha256(Path(path).read_bytes()).digest()
            total.update(known.get(path, b""))
        # A test that names no program that was built may look at anything.
        now[test["name"]] = total.hexdigest() if programs else ""
        if not now[test["name"]] or passed.get(test["name"]) != now[test["name"]]:
            run.append(number)
    return (None if len(run) == len(listed["tests"]) else run), now


def skipped_tests(build):
    """How many tests of a build's last run were skipped, by the reason that they gave."""
    log = build / "Testing" / "Temporary" / "LastTest.log"
    return Counter(re.findall(r": Skipped\n(.*)", log.read_text(errors="replace"))) if log.exists() else Counter()


class Part:
    def __init__(self, name):
        self.row = PARTS[name]
        self.name = name
        self.build = ROOT / "build" / name
        self.log = self.build / "part.log"
        self.jobs = os.environ.get("DETENT_JOBS", str(PROCESSORS))
        self.skipped = Counter()
        self.build.mkdir(parents=True, exist_ok=True)
        self.log.write_text("")

    def step(self, what, command, cwd=ROOT):
        note("step", self.name, step=what)
        with open(self.log, "a") as log:
            log.write("$ " + shlex.join(map(str, command)) + "\n")
            log.flush()
            code = subprocess.run(list(map(str, command)), cwd=cwd, stdout=log, stderr=log, stdin=subprocess.DEVNULL).returncode
        if code in (0, 77):
            return code
        lines = self.log.read_text(errors="replace").splitlines()
        quiet = re.compile(r"^ +Start |   Passed ")
        print("\n".join([line for line in lines if not quiet.search(line)][-120:]))
        print(f"{self.name}: {what} failed; all of it: {self.log.relative_to(ROOT)}")
        note("failed", self.name, step=what)
        sys.exit(1)

    def suite(self):
        row = self.row
        configs = configs_of(row).replace(" ", ";")
        tested, _, programs = chosen(row["unit_tests"]).partition(":")
        options = [f"-DDETENT_CONFIGS={configs}", f"-DDETENT_CONFIG={configs.split(';')[0]}", "-DDETENT_TESTS=ON",
                   "-DDETENT_TOOLS=OFF", "-DDETENT_EXAMPLES=OFF", "-DDETENT_UNITY_TESTS=ON", *shlex.split(row["options"]),
                   f"-DDETENT_TESTED_CONFIGS={tested.strip().replace(' ', ';') or 'none'}",
                   f"-DDETENT_TESTED_PROGRAMS={programs.strip() or '.*'}"]
        variant = row["flags"] != ""
        if variant:
            options += [f"-DDETENT_VARIANT={self.name}", f"-DCMAKE_CXX_FLAGS_RELEASE={row['flags']} -DNDEBUG"]
        self.step("configure", ["cmake", "--preset", row["target"], "-B", self.build, *options])
        self.step("build", ["cmake", "--build", self.build, "-j", self.jobs, "--target", "lockstep_programs" if variant else "all"])
        built = processor_seconds()

        selection = ["-L", "lockstep"] if variant else ["-LE", "slow"] if row["when"] == "quick" else []
        stamps = self.build / "passed.json"
        passed = json.loads(stamps.read_text()) if stamps.exists() and not os.environ.get("DETENT_AGAIN") else {}
        run, now = cached_tests(self.build, passed)
        stamps.unlink(missing_ok=True)
        if run is not None:
            selection += ["-I", ",".join(map(str, [0, 0, 0, *run] if run else [1, 1, 10**9]))]
        limit = 86400 if os.environ.get("DETENT_FULL") else 1200
        self.step("test", ["ctest", "--test-dir", self.build, "-j", self.jobs, "--timeout", limit, "--output-on-failure",
                           *([] if run is not None else ["--no-tests=error"]), *selection])
        stamps.write_text(json.dumps(now))
        self.skipped = skipped_tests(self.build)
        summary = re.findall(r"^.*tests passed.*$", self.log.read_text(errors="replace"), re.M)
        kept = "" if run is None else f", {len(now) - len(run)} unchanged"
        return built, (summary[-1] if summary else "nothing to run") + kept

    def run(self):
        begin = time.time()
        files = source_files()
        digest = digest_of(self.row, files)
        stamp = MATRIX / "passed" / self.name
        if not os.environ.get("DETENT_AGAIN") and stamp.exists() and stamp.read_text() == digest:
            note("unchanged", self.name)
            print("unchanged since it passed")
            return
        stamp.parent.mkdir(exist_ok=True)
        stamp.unlink(missing_ok=True)
        if self.row["command"]:
            command = shlex.split(self.row["command"])
            if os.environ.get("DETENT_FULL") and self.name == "fuzzing":
                command = [command[0], "--seconds", "3600"]
            code = self.step("run", [ROOT / command[0], *command[1:]])
            built, said = 0.0, self.log.read_text(errors="replace").strip().splitlines()[-1]
            if code == 77:
                print(said)
                note("skipped", self.name)
                sys.exit(77)
        else:
            built, said = self.suite()
        total = processor_seconds()
        times = {"wall": time.time() - begin, "build": built, "test": total - built}
        print(said)
        self.check_budget(times)
        note("passed", self.name, said=said, skipped=self.skipped, **times)
        stamp.write_text(digest)

    def check_budget(self, times):
        scale = MARGIN * max(1.0, float(os.environ.get("DETENT_MACHINE", "1")))
        for what, seconds in zip(("build", "test"), budget(self.row)):
            if times[what] > seconds * scale and not os.environ.get("DETENT_FULL"):
                print(f"{self.name}: its {what} took {times[what]:.0f} s of a processor, more than {scale:.1f} times the {seconds} s of tests/parts.csv")
                note("failed", self.name, step=f"{what} over its budget", **times)
                sys.exit(1)


# All parts


def text_of(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


class Progress(threading.Thread):
    """Tells what the parts note, with an estimate of what is left, by their budgets and the time that the others took."""

    def __init__(self, parts):
        super().__init__(daemon=True)
        self.left = {part["part"]: sum(budget(part)) for part in parts}
        self.count, self.done, self.spent, self.begin, self.over = len(parts), 0, 0.0, time.time(), False
        self.results, self.terminal = {}, sys.stdout.isatty()

    def estimate(self):
        spent = self.spent
        if self.done < 2 or spent <= 0:
            return ""
        return f", about {text_of((time.time() - self.begin) * sum(self.left.values()) / spent)} left"

    def run(self):
        with open(PROGRESS) as file:
            while True:
                line = file.readline()
                if line:
                    self.tell(json.loads(line))
                elif self.over:
                    return
                else:
                    time.sleep(0.3)

    def tell(self, event):
        name = event["part"]
        if event["kind"] == "step":
            line = f"{name}: {event['step']}"
            print(f"\r\033[K    {line}{self.estimate()}" if self.terminal else f"    {time.strftime('%T')}  {line}",
                  end="" if self.terminal else "\n", flush=True)
            return
        self.done += 1
        self.spent += self.left.pop(name, 0)
        self.results[name] = event
        said = {"unchanged": "unchanged since it passed", "failed": f"FAILED: {event.get('step')}", "skipped": "skipped"}.get(
            event["kind"], f"{event.get('said', '')}, {text_of(event.get('wall', 0))}")
        print(("\r\033[K" if self.terminal else "") + f"[{self.done}/{self.count}] {name}: {said}{self.estimate()}", flush=True)


def calibrate():
    """How much slower than the machine of the budgets this one is: by the time of a fixed compilation."""
    source = "/usr/src/googletest/googletest/src/gtest-all.cc"
    before = processor_seconds()
    if subprocess.run(["g++", "-O1", "-I/usr/src/googletest/googletest/include", "-I/usr/src/googletest/googletest", "-c", source,
                       "-o", "/dev/null"]).returncode:
        return 1.0
    return (processor_seconds() - before) / 6.0


def choose(arguments):
    rows = list(PARTS.values())
    if arguments.quick:
        return [row for row in rows if row["when"] == "quick"]
    rows = [row for row in rows if row["when"] == "" or (row["when"] == "full" and arguments.full)]
    if arguments.targets:
        wanted = arguments.targets
        rows = [row for row in rows if (row["target"] in wanted if row["target"] else all(need in wanted for need in row["needs"].split()))]
    if arguments.parts:
        rows = [PARTS[name] for name in arguments.parts]
    if arguments.changed:
        changed = subprocess.run(["git", "diff", "--name-only", arguments.changed], cwd=ROOT, capture_output=True, text=True)
        if changed.returncode:
            sys.exit(f"test: {changed.stderr.strip()}")
        untracked = subprocess.run(["git", "ls-files", "-o", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True)
        files = changed.stdout.split() + untracked.stdout.split()
        rows = [row for row in rows if inputs_of(row, files)]
        print(f"test: {len(files)} files have changed since {arguments.changed}, which {len(rows)} parts depend on")
    return rows


def write_outer(rows):
    names = [row["part"] for row in rows]
    lines = []
    for row in rows:
        name = row["part"]
        after = [need for need in row["needs"].split() if need in names]
        lines.append(f'add_test("{name}" "{__file__}" run "{name}")\n'
                     f'set_tests_properties("{name}" PROPERTIES DEPENDS "{";".join(after)}" TIMEOUT {86400 if os.environ.get("DETENT_FULL") else 3000} '
                     f'SKIP_RETURN_CODE 77 COST {sum(budget(row))})\n')
    builds = [row["part"] for row in rows if not row["command"] and row["when"] != "quick"]
    if builds:
        lockstep = ROOT / "tests" / "campaigns" / "lockstep"
        # Last of all, so that ctest starts the others by their cost.
        everything = ";".join(names)
        lines.append(f'add_test(every_tick_is_equal_on_every_build "{lockstep}/gather" "{ROOT}/build/lockstep.csv" '
                     + " ".join(f'"{name}"' for name in builds) + ")\n"
                     f'set_tests_properties(every_tick_is_equal_on_every_build PROPERTIES DEPENDS "{everything}")\n')
        if not os.environ.get("DETENT_WRITE_TABLES"):
            lines.append(f'add_test(committed_table_has_these_digests "{lockstep}/table" "{ROOT}/build/lockstep.csv" --check "{ROOT}/docs/lockstep.md")\n'
                         'set_tests_properties(committed_table_has_these_digests PROPERTIES DEPENDS every_tick_is_equal_on_every_build)\n')
    (MATRIX / "CTestTestfile.cmake").write_text("".join(lines))
    (MATRIX / "Testing" / "Temporary" / "CTestCostData.txt").unlink(missing_ok=True)


def write_times(rows, results):
    """docs/testing.md: the table of parts with the times of this run."""
    page = ROOT / "docs" / "testing.md"
    text = page.read_text()
    lines = ["| part | what it proves | build, s | tests, s |", "|---|---|---|---|"]
    for row in rows:
        event = results.get(row["part"], {})
        lines.append(f"| {row['part']} | {row['proves']} | {event.get('build', 0):.0f} | {event.get('test', 0):.0f} |")
    begin, end = "<!-- parts -->\n", "<!-- end of parts -->"
    page.write_text(text[: text.index(begin) + len(begin)] + "\n".join(lines) + "\n" + text[text.index(end):])


def main():
    parser = argparse.ArgumentParser(prog="./test", formatter_class=argparse.RawDescriptionHelpFormatter, description="""\
Builds and tests Detent. Without options: every part of tests/parts.csv, on all targets; it says what it installs, tells how far
it is, and ends in a summary. A part whose files and tools are those with which it passed is not run again. The log of a part is
build/PART/part.log. Exit code 0 only if everything passed.""")
    parser.add_argument("--quick", action="store_true", help="the unit tests and replays of fx64 on this machine: for every edit")
    parser.add_argument("--changed", metavar="COMMIT", nargs="?", const="HEAD",
                        help="the parts that depend on what has changed since COMMIT (HEAD)")
    parser.add_argument("--targets", metavar="LIST", help="the parts of these targets, separated by commas")
    parser.add_argument("--parts", metavar="LIST", help="these parts, separated by commas")
    parser.add_argument("--full", action="store_true",
                        help="also the parts for a long run, the exhaustive sweeps of the arithmetic, and an hour of each fuzzer")
    parser.add_argument("--again", action="store_true", help="run also what has not changed since it passed")
    parser.add_argument("--list", action="store_true", help="print the parts and what each is for")
    parser.add_argument("--write-tables", action="store_true",
                        help="write docs/lockstep.md and docs/testing.md from what was measured, instead of checking the former")
    arguments = parser.parse_args()
    for option, known in (("targets", TARGETS), ("parts", PARTS)):
        value = getattr(arguments, option)
        if value:
            names = [name for name in re.split("[, ]+", value) if name]
            unknown = [name for name in names if name not in known]
            if unknown:
                parser.error(f"no {option[:-1]} '{unknown[0]}'; there are: {', '.join(known)}")
            setattr(arguments, option, names)
    if arguments.list:
        for row in PARTS.values():
            print(f"{row['part']:<24} {row['when'] or 'always':<7} {sum(budget(row)):>5} s  {row['proves']}")
        return 0
    if arguments.write_tables and (arguments.quick or arguments.changed or arguments.targets or arguments.parts):
        parser.error("--write-tables needs all parts")

    if arguments.full:
        os.environ["DETENT_FULL"] = "1"
    if arguments.again or arguments.write_tables:
        os.environ["DETENT_AGAIN"] = "1"
    if arguments.write_tables:
        os.environ["DETENT_WRITE_TABLES"] = "1"
    rows = choose(arguments)
    if not rows:
        print("test: nothing to run")
        return 0
    targets = sorted({name for row in rows for name in [row["target"], *row["needs"].split()] if name in TARGETS})
    subprocess.run(["toolchains/setup", *targets], cwd=ROOT, check=True)
    if "s390x" in targets:
        subprocess.run(["toolchains/foreign-packages", "s390x", "build/packages/s390x", "libenet-dev", "libenet7"], cwd=ROOT)
    os.environ["CCACHE_BASEDIR"] = str(ROOT)
    os.environ["CCACHE_SLOPPINESS"] = "pch_defines,time_macros"
    if not os.access(os.path.expanduser("~"), os.W_OK):
        os.environ["CCACHE_DIR"] = str(ROOT / "build" / "ccache")
    os.environ["DETENT_JOBS"] = str((PROCESSORS + len(rows) - 1) // len(rows))
    MATRIX.mkdir(parents=True, exist_ok=True)
    PROGRESS.write_text("")
    os.environ["DETENT_MACHINE"] = f"{calibrate():.2f}"
    seconds = sum(sum(budget(row)) for row in rows) / PROCESSORS
    print(f"test: {len(rows)} parts, {PROCESSORS} at once, up to {text_of(seconds)} where nothing is built yet")
    write_outer(rows)
    progress = Progress(rows)
    progress.start()
    code = subprocess.run(["ctest", "--test-dir", MATRIX, "-j", str(PROCESSORS), "--output-on-failure", "-Q", "-O", MATRIX / "ctest.log"]).returncode
    progress.over = True
    progress.join()
    failed = summarise(rows, progress)
    print("\n".join((MATRIX / "ctest.log").read_text(errors="replace").splitlines()[-(12 if code == 0 else 60):]))
    show_failures(failed)
    if code == 0 and arguments.write_tables:
        (ROOT / "docs" / "lockstep.md").write_text(
            subprocess.run(["tests/campaigns/lockstep/table", "build/lockstep.csv"], cwd=ROOT, check=True, capture_output=True, text=True).stdout)
        write_times(rows, progress.results)
        print("test: wrote docs/lockstep.md and docs/testing.md")
    return code


def summarise(rows, progress):
    """Once more, for a person: how long, what took longest, what failed, and how much of it did not have to run."""
    results = progress.results
    kinds = {kind: [name for name, event in results.items() if event["kind"] == kind] for kind in ("passed", "unchanged", "skipped", "failed")}
    with open(MATRIX / "times.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["part", "result", "wall", "build", "test"])
        for name, event in results.items():
            writer.writerow([name, event["kind"], *(f"{event.get(key, 0):.1f}" for key in ("wall", "build", "test"))])
    print(f"\ntest: {text_of(time.time() - progress.begin)}; "
          + ", ".join(f"{len(names)} {kind}" for kind, names in kinds.items() if names) + f" of {len(rows)} parts")
    longest = sorted((event for event in results.values() if "wall" in event), key=lambda event: -event["wall"])[:5]
    if longest:
        print("longest: " + ", ".join(f"{event['part']} {text_of(event['wall'])}" for event in longest)
              + "; all of them: build/matrix/times.csv")
    skipped = sum((Counter(event.get("skipped", {})) for event in results.values()), Counter())
    if skipped:
        print(f"skipped tests: {skipped.total()}: " + "; ".join(f"{reason} ({count})" for reason, count in skipped.most_common()))
    for name in kinds["failed"]:
        print(f"FAILED: {name} ({results[name]['step']}): build/{name}/part.log")
    return kinds["failed"]


def show_failures(names):
    """The end of what each part that failed said, last of all: where a log is cut, its end is what remains."""
    for name in names:
        log = ROOT / "build" / name / "part.log"
        lines = log.read_text(errors="replace").splitlines() if log.exists() else []
        quiet = re.compile(r"^ +Start |   Passed |\(Skipped\)$|\*\*\*Skipped")
        print(f"\n{name}:\n" + "\n".join([line for line in lines if not quiet.search(line)][-30:]))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "run":
        Part(sys.argv[2]).run()
    else:
        sys.exit(main())
