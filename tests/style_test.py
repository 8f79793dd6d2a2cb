#!/usr/bin/env python3
"""The style gate reports planted offences of each kind, once each, and nothing in good text."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

STYLE = pathlib.Path(__file__).with_name("style.py")
LONG = " ".join(["word"] * 41) + ".\n"
GOOD = {"good.h": "/// Returns the step (s).\nint step;  // in samples; what follows is not a beginning\n",
        "good.md": "# A title\n" + LONG.replace("word word", "word. Word") + "\n```\n" + LONG + "```\n"}


class StyleGate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.git("init", "-q")
        self.commit("start", {"old.h": "// Of old, with no name.\n"})
        self.base = self.git("rev-parse", "HEAD").strip()

    def git(self, *words):
        who = ("-c", "user.name=a", "-c", "user.email=a@b")
        return subprocess.run(("git", *who, *words), cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def commit(self, subject, files):
        for name, text in files.items():
            (self.folder / name).write_text(text)
        self.git("add", ".")
        self.git("commit", "-q", "--allow-empty", "-m", subject)

    def offences(self):
        run = subprocess.run((sys.executable, STYLE, self.base), cwd=self.folder, capture_output=True, text=True)
        found = run.stdout.splitlines() if run.returncode else []
        self.assertEqual(run.returncode, 1 if found else 0, run.stderr)
        return found

    def test_good_text_passes(self):
        self.commit("mysim: add a step", GOOD)
        self.assertEqual(self.offences(), [])

    def test_each_planted_offence_is_reported_once(self):
        bad = "/// Of any step.\nint step;  // what a step is\n// Why a step.\nint next;  // from the step\n"
        self.commit("mysim: add a step", GOOD | {"bad.h": bad})
        self.commit("docs: say more", {"bad.md": "- " + LONG})
        self.commit("Say more", {})
        self.git("checkout", "-q", "-b", "side", self.base)
        self.commit("report: do something on the side " + "x" * 60, {})
        self.git("checkout", "-q", "-")
        self.git("merge", "-q", "--no-ff", "-m", "report: merge a topic", "side")
        found = self.offences()
        for part in ("bad.h:1: comment", "bad.h:2: comment", "bad.h:3: comment", "bad.h:4: comment",
                     "bad.md:1: sentence of 41 words", "without a room", "subject of 93 characters", "merge commit"):
            self.assertEqual(sum(part in line for line in found), 1, (part, found))
        self.assertEqual(len(found), 8, found)


if __name__ == "__main__":
    unittest.main()
