#!/usr/bin/env python3
"""Style gate: all comments and sentences of the tree, and commit subjects since a recorded commit.

    tests/style.py [BASE]      prints one line per offence; exit status 1 if there are any

Checks the working tree of the current folder's repository; with BASE, only what differs from it.
"""
import re
import subprocess
import sys

BASE = "8a3fe1f35a065ebede9c13199557e67aea004d12"  # older commit subjects stay
EMPTY_TREE = "4b825dc642cb6eb9a060e54bf8d69288fbee4904"  # git's name for it in every repository

# Permitted offences: part of the reported line -> reason.
CORPUS = "patterns of the corpus match the text of what students get and hand in"
EXCEPTIONS = {
    f"tests/coursework/{file}:": CORPUS
    for file in ("a1-steppers/handout.md", "a2-pendulum/starter/pendulum.h", "a3-cloth/starter/cloth.h",
                 "a4-collision/handout.md", "a4-collision/starter/contact.h", "a4-collision/styles/impulses/velocity.cpp",
                 "a5-stiff/handout.md", "a5-stiff/starter/jacobian.cpp", "a5-stiff/styles/algorithms/choose.cpp",
                 "cheats/cheat.h", "classic/handout.md", "classic/solution/particleSystem.h",
                 "classic/starter/particleSystem.h", "classic/styles/apart/Force.h", "m1-misconceptions/solution/sag.cpp",
                 "m1-misconceptions/starter/beliefs.h")
}

# Words that no comment begins with.
OPENING = ("Of", "From", "What", "Whether", "Who", "Whose", "Why", "How", "Where", "The same")
COMMENT = {"cpp": "//", "h": "//", "hpp": "//", "ts": "//", "js": "//", "mjs": "//", "py": "#", "sh": "#", "cmake": "#"}
LONGEST_SENTENCE = 40  # words
LONGEST_SUBJECT = 72  # characters


def git(*words):
    return subprocess.run(("git", "-c", "core.quotePath=false", *words), check=True, capture_output=True, text=True,
                          errors="replace").stdout


def changed_lines(base):
    """Line numbers (from 1) that differ from base, by path."""
    changed, path = {}, ""
    for line in git("diff", "-U0", "--no-renames", base).splitlines():
        if line.startswith("+++ "):
            path = line[6:]
        elif hunk := re.match(r"@@ \S+ \+(\d+)(?:,(\d+))? @@", line):
            first, count = int(hunk[1]), int(hunk[2] or 1)
            changed.setdefault(path, set()).update(range(first, first + count))
    return changed


def comment_offences(lines, marker, changed):
    """Comments that begin with one of OPENING. In later lines of a comment, only capitalised words count."""
    before = False  # the line above is a comment
    for number, line in enumerate(lines, 1):
        whole = re.match(rf"\s*{marker}+!?<?\s*(.*)", line)
        trailing = None if whole else re.search(rf"(?:^|\s\s){marker}+!?<?\s+([^\"]*)$", line)
        text = (whole or trailing or [None, ""])[1]
        flags = 0 if whole and before else re.IGNORECASE
        if number in changed and re.match(rf"({'|'.join(OPENING)})\b", text, flags):
            yield number, "comment begins with '" + " ".join(text.split()[:4]) + "'"
        before = bool(whole)


def sentences(lines):
    """(first line, last line, words) of each sentence of a Markdown text; code and headings are left out."""
    paragraph, code = [], False
    for number, line in enumerate([*lines, ""], 1):
        if line.lstrip().startswith("```"):
            code = not code
        if not code and line.strip() and not re.match(r"\s*(```|#|\||[-*] |\d+\. |>)", line):
            paragraph += [(number, word) for word in words_of(line)]
            continue
        yield from split_sentences(paragraph)
        paragraph = []
        if not code and re.match(r"\s*([-*] |\d+\. |>)", line):
            paragraph = [(number, word) for word in words_of(line)[1:]]
        elif not code and line.lstrip().startswith("|"):
            for cell in line.split("|"):
                yield from split_sentences([(number, word) for word in words_of(cell)])


def words_of(line):
    line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)  # a link counts by its text
    return re.sub(r"`[^`]*`", "CODE", line).split()


def split_sentences(words):
    begin = 0
    for i, (number, word) in enumerate(words):
        if re.search(r"[.!?][)\"'*_]*$", word) or i + 1 == len(words):
            yield words[begin][0], number, i + 1 - begin
            begin = i + 1


def subject_offences(base):
    for line in git("log", "--format=%h%x09%p%x09%s", f"{base}..HEAD").splitlines():
        commit, parents, subject = line.split("\t", 2)
        if len(parents.split()) > 1:
            yield f"{commit}: merge commit; rebase instead"
        elif len(subject) > LONGEST_SUBJECT:
            yield f"{commit}: subject of {len(subject)} characters, at most {LONGEST_SUBJECT}: {subject}"
        elif not re.match(r"[a-z][\w./+-]*: \S", subject):
            yield f"{commit}: subject without a room in front: {subject}"


def offences(base, subjects_since):
    for path, changed in sorted(changed_lines(base).items()):
        suffix = path.rsplit(".", 1)[-1]
        if suffix not in COMMENT and suffix != "md":
            continue
        try:
            with open(path, encoding="utf-8", errors="replace") as file:
                lines = file.read().splitlines()
        except FileNotFoundError:
            continue  # deleted
        if suffix == "md":
            for first, last, words in sentences(lines):
                if words > LONGEST_SENTENCE and changed & set(range(first, last + 1)):
                    yield f"{path}:{first}: sentence of {words} words, at most {LONGEST_SENTENCE}"
        else:
            yield from (f"{path}:{number}: {what}" for number, what in comment_offences(lines, COMMENT[suffix], changed))
    yield from subject_offences(subjects_since)


def main():
    found = [line for line in offences(*(sys.argv[1:2] * 2 or (EMPTY_TREE, BASE)))
             if not any(part in line for part in EXCEPTIONS)]
    print("\n".join(found) if found else "style: no offences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
