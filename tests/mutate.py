#!/usr/bin/env python3
"""Damages CAD files in ways that a seed decides, and meshes each: the end must be a mesh or one clear sentence.

mutate.py --quadrille build/quadrille [--count 1000] [--seed 1] [--time-limit 10] [--keep FOLDER] MODEL...

Files are cut off, get bits flipped, bytes or numbers replaced, lines dropped, doubled or exchanged. A run is good that
ends within its time limit (and half a second) with exit code 0 and a mesh, or with 1 or 2, one line on stderr and no
file. The bad ones are kept and listed; the exit code is 1 if there is one.
"""
import argparse
import collections
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

NUMBER = re.compile(rb"-?\d+(\.\d*)?([eE][-+]?\d+)?")
NUMBERS = [b"0", b"-1", b"1", b"2147483647", b"-2147483648", b"1e308", b"-1e308", b"1e-308", b"nan", b"99999999999999999999"]


def cut_off(data, rng):
    return data[: rng.randrange(len(data))]


def flip_bits(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice([1, 3, 20])):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def replace_bytes(data, rng):
    start = rng.randrange(len(data))
    length = rng.choice([1, 4, 64])
    return data[:start] + rng.randbytes(length) + data[start + length :]


def replace_numbers(data, rng):
    places = [match.span() for match in NUMBER.finditer(data)]
    if not places:
        return cut_off(data, rng)
    for start, end in sorted(rng.sample(places, min(len(places), rng.choice([1, 2, 5]))), reverse=True):
        data = data[:start] + rng.choice(NUMBERS) + data[end:]
    return data


def exchange_lines(data, rng):
    lines = data.split(b"\n")
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(3)
    if kind == 0:
        lines[a], lines[b] = lines[b], lines[a]
    elif kind == 1:
        del lines[a : a + rng.choice([1, 5])]
    else:
        lines.insert(b, lines[a])
    return b"\n".join(lines)


MUTATIONS = [cut_off, flip_bits, replace_bytes, replace_numbers, exchange_lines]


def run_once(arguments, path, folder):
    out = os.path.join(folder, "out.msh")
    for name in os.listdir(folder):
        os.unlink(os.path.join(folder, name))
    command = [arguments.quadrille, "mesh", path, "-o", out, "--quiet", "--elements-per-diagonal", "15",
               "--time-limit", str(arguments.time_limit)]
    start = time.time()
    try:
        process = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=arguments.time_limit + 5)
    except subprocess.TimeoutExpired:
        return "hangs", ""
    seconds = time.time() - start
    message = process.stderr.decode(errors="replace").strip()
    files = os.listdir(folder)
    if seconds > arguments.time_limit + 0.5:
        return "too slow", message
    if process.stdout:
        return "prints to stdout", message
    if process.returncode == 0:
        return ("mesh", message) if files == ["out.msh"] else ("no mesh", message)
    if process.returncode not in (1, 2):
        return f"exit code {process.returncode}", message
    if files:
        return "half a file", message
    if not message.startswith("quadrille: ") or "\n" in message:
        return "not one sentence", message
    if "crashed" in message:
        return "crash, told", message
    return ("time limit, told" if "time limit" in message else "error, told"), message


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+")
    parser.add_argument("--quadrille", required=True)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-limit", type=float, default=10)
    parser.add_argument("--keep", help="folder for the files that ended badly")
    arguments = parser.parse_args()
    good = {"mesh", "error, told", "crash, told", "time limit, told"}
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as damaged:
        for i in range(arguments.count):
            rng = random.Random(f"{arguments.seed}/{i}")
            model = arguments.models[i % len(arguments.models)]
            mutation = rng.choice(MUTATIONS)
            with open(model, "rb") as file:
                data = mutation(file.read(), rng)
            path = os.path.join(damaged, "damaged" + os.path.splitext(model)[1])
            with open(path, "wb") as file:
                file.write(data)
            end, message = run_once(arguments, path, folder)
            counts[end] += 1
            if end in good and not end.startswith(("crash", "time")):
                continue
            print(f"{i}: {os.path.basename(model)}, {mutation.__name__}: {end}: {message[:200]}", flush=True)
            if arguments.keep and end not in good:
                os.makedirs(arguments.keep, exist_ok=True)
                shutil.copy(path, os.path.join(arguments.keep, f"{i}-{os.path.basename(model)}"))
    print(", ".join(f"{count} {end}" for end, count in counts.most_common()))
    return 0 if set(counts) <= good else 1


if __name__ == "__main__":
    sys.exit(main())
