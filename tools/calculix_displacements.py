#!/usr/bin/env python3
"""Displacements that CalculiX computes for a small deck with generated nodes and elements.

    tools/calculix_displacements.py DECK.inp NODE [NODE ...]

CalculiX knows no *NGEN, *NFILL and *ELGEN: the script writes nodes and elements out, calls the program `ccx` (package calculix-ccx of Debian), and
prints the displacements of nodes, in units of the deck, with their places. docs/guide/other-models.md has its numbers.
"""

import math
import subprocess
import sys
import tempfile
from pathlib import Path


def blocks(text):
    """Keywords with their data lines, in capital letters."""
    found = []
    for line in text.upper().splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            name, *parameters = [part.strip() for part in line[1:].split(",")]
            pairs = [part.partition("=") for part in parameters]
            found.append((name, {key.strip(): value.strip() for key, _, value in pairs}, []))
        else:
            found[-1][2].append([part.strip() for part in line.strip().strip(",").split(",")])
    return found


class Mesh:
    def __init__(self):
        self.nodes, self.sets, self.elements, self.lines = {}, {}, {}, []

    def generate(self, parameters, rows):
        for row in rows:
            first, last = int(row[0]), int(row[1])
            step = int(row[2]) if len(row) > 2 else 1
            count = (last - first) // step
            a, b = self.nodes[first], self.nodes[last]
            for k in range(count + 1):
                share = k / count
                point = [p + share * (q - p) for p, q in zip(a, b)]
                if "LINE" in parameters:
                    centre = self.nodes[int(row[3])]
                    angles = [math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (a, b)]
                    angle, radius = angles[0] + share * (angles[1] - angles[0]), math.dist(a, centre)
                    point = [centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle), 0.0]
                self.nodes[first + k * step] = point
            self.add(parameters.get("NSET"), range(first, last + 1, step))

    def fill(self, parameters, rows):
        for one, other, count, step in rows:
            for low, high in zip(sorted(self.sets[one]), sorted(self.sets[other])):
                a, b = self.nodes[low], self.nodes[high]
                for k in range(int(count) + 1):
                    share = k / int(count)
                    self.nodes[low + k * int(step)] = [p + share * (q - p) for p, q in zip(a, b)]
                self.add(parameters.get("NSET"), range(low, high + 1, int(step)))

    def copy_elements(self, parameters, rows):
        for row in rows:
            master, *numbers = [int(field) for field in row]
            numbers += [1, 0, 0] * 3
            kind, nodes = self.elements[master]
            (a, na, ea), (b, nb, eb), (c, nc, ec) = (numbers[k : k + 3] for k in (0, 3, 6))
            for i in range(a):
                for j in range(b):
                    for k in range(c):
                        label = master + i * ea + j * eb + k * ec
                        self.elements[label] = (kind, [it + i * na + j * nb + k * nc for it in nodes])
                        self.add(parameters.get("ELSET"), [label])

    def add(self, name, members):
        if name:
            self.sets.setdefault(name, set()).update(members)

    def read(self, name, parameters, rows):
        if name == "NODE":
            new = {int(row[0]): ([float(it) for it in row[1:]] + [0.0])[:3] for row in rows}
            self.nodes.update(new)
            self.add(parameters.get("NSET"), new)
        elif name == "ELEMENT":
            fields = [int(field) for row in rows for field in row]
            size = {"C3D20R": 21}.get(parameters["TYPE"], len(rows[0]))
            for k in range(0, len(fields), size):
                self.elements[fields[k]] = (parameters["TYPE"], fields[k + 1 : k + size])
        elif name in ("NSET", "ELSET"):
            for row in rows:
                first, last, step = (int(it) for it in (row + ["1"])[:3])
                self.add(parameters[name], range(first, last + 1, step))
        elif name in ("NGEN", "NFILL", "ELGEN"):
            {"NGEN": self.generate, "NFILL": self.fill, "ELGEN": self.copy_elements}[name](parameters, rows)
        else:
            words = [name] + [f"{key}={value}" if value else key for key, value in parameters.items()]
            self.lines.append("*" + ", ".join(words))
            self.lines.extend(", ".join(row) for row in rows)

    def text(self, printed):
        used = {node for _, nodes in self.elements.values() for node in nodes}
        lines = ["*NODE, NSET=ALL_NODES"]
        lines += [f"{label}, {x:.12g}, {y:.12g}, {z:.12g}" for label, (x, y, z) in self.nodes.items() if label in used]
        for label, (kind, nodes) in self.elements.items():
            fields = [str(label)] + [str(node) for node in nodes]
            lines += [f"*ELEMENT, TYPE={kind}", ", ".join(fields[:12]) + "," * (len(fields) > 12)]
            lines += [", ".join(fields[12:])] * (len(fields) > 12)
        for name, members in self.sets.items():
            of_elements = name in ("BODY", "PLATE", "DAM", "RING", "STRIP", "BAR", "LOWER", "UPPER", "INSIDE", "END")
            members = sorted(members if of_elements else members & used)
            lines += ["*ELSET, ELSET=" + name if of_elements else "*NSET, NSET=" + name] if members else []
            lines += [f"{member}," for member in members]
        lines += ["*NSET, NSET=PRINTED"] + [f"{node}," for node in printed]
        return "\n".join(lines + self.lines).replace("*END STEP", "*NODE PRINT, NSET=PRINTED\nU\n*END STEP") + "\n"


def main(deck, *printed):
    mesh = Mesh()
    for block in blocks(Path(deck).read_text()):
        mesh.read(*block)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "deck.inp").write_text(mesh.text(printed))
        run = subprocess.run(["ccx", "deck"], cwd=folder, capture_output=True, text=True)
        results = Path(folder, "deck.dat")
        if not results.is_file():
            sys.exit(run.stdout + run.stderr)
        is_displacement, found = False, {}
        for line in results.read_text().splitlines():
            if "for set" in line:
                is_displacement = "displacements" in line
            elif line.strip() and is_displacement:
                node, *values = line.split()
                found[node] = [float(it) for it in values]
    if not found:
        sys.exit(run.stdout + run.stderr)
    for node, values in found.items():
        print(f"node {node} at {mesh.nodes[int(node)]}: " + ", ".join(f"{it:.5e}" for it in values))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
