# SPDX-License-Identifier: GPL-3.0-or-later
"""What notebooks show of results and documents. All text is escaped here, and nowhere else."""

from __future__ import annotations

import base64
from html import escape
from typing import Sequence


def html_of(headline: str, lines: Sequence[str] = (), svg: str = "", *, table: str = "", after: Sequence[str] = ()) -> str:
    """A headline with what is below it. A picture is shown as an image: no script in it runs, and it loads nothing.

    Parameters
    ----------
    svg : str
        a picture, of whatever origin
    table : str
        a table as HTML that pandas has made
    """
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    picture = base64.b64encode(svg.encode("utf-8", "replace")).decode("ascii")
    return ('<div class="tex2jax_ignore mathjax_ignore">'  # no mathematics is looked for in texts
            f"<p><b>{escape(headline)}</b></p>" + (f"<ul>{items}</ul>" if items else "") + table
            + (f'<img alt="" src="data:image/svg+xml;base64,{picture}">' if svg else "")
            + "".join(f"<p>{escape(line)}</p>" for line in after) + "</div>")
