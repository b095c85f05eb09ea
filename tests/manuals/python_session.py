# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the Python blocks of a manual, which share their names: a JSON document {"text", "line", "name"} on every line of standard
input; for each a line {"failed", "output"} on what was standard output. A block with prompts (>>>) is compared as doctest does."""
import contextlib
import doctest
import io
import json
import os
import sys
import traceback

names = {"__name__": "__main__"}
answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)  # what a library prints by itself is no answer
for request in sys.stdin:
    block = json.loads(request)
    output, failed = io.StringIO(), False
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
        if ">>> " in block["text"]:
            test = doctest.DocTestParser().get_doctest(block["text"], names, block["name"], block["name"], block["line"])
            failed = doctest.DocTestRunner(verbose=False).run(test, out=output.write, clear_globs=False).failed > 0
            names.update(test.globs)  # which is a copy
        else:
            try:
                exec(compile("\n" * block["line"] + block["text"], block["name"], "exec"), names)
            except BaseException:  # SystemExit, too: the next blocks are run
                failed = True
                traceback.print_exc()
    print(json.dumps({"failed": failed, "output": output.getvalue()}), file=answers, flush=True)
answers.close()
