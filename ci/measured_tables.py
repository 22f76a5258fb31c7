"""The tables of the documents that quote a whole run. reports/measured/*.csv are tables of one
`glovebench reproduce --seeds 8`, copied from tables/ of its folder; `ci/readme` writes what TABLES returns."""

import csv
import pathlib

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "reports/measured"
ERRORS = ["position_error_mm", "posture_rms_deg", "rotation_error_deg"]


def rows_of(name):
    with (FOLDER / f"{name}.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text, digits=2):
    return f"{float(text):.{digits}f}" if text else ""


def percent(share):
    return number(100 * float(share), 1) if share else ""


def table(headings, rows, words=1):
    """Markdown. The first columns hold words."""
    rules = ["---"] * words + ["---:"] * (len(headings) - words)
    return "".join(f"| {' | '.join(cells)} |\n" for cells in [headings, rules, *rows])


def source_of(rows):
    return f"Measured at {rows[0]['run'][:7]}, noise seeds 1 to {rows[0]['seeds']}.\n\n" if "seeds" in rows[0] else ""


def figure4():
    """Figure 4 whole: a row for each movement and database, columns for each truth and subject."""
    rows = rows_of("figure4")
    groups = [("recorded", "1"), ("source", "1"), ("source", "2")]
    cells = {(row["trajectory"], row["database"], row["truth"], row["subject"]): row for row in rows}
    lines = []
    for trajectory, database in dict.fromkeys((row["trajectory"], row["database"]) for row in rows):
        line = [trajectory, database.removeprefix("DB_")]
        for group in groups:
            row = cells[trajectory, database, *group]
            line += [number(row[f"{error}_mean"]) for error in ERRORS]
            if group == ("recorded", "1"):
                line[2:] = [f"{ours} ({number(paper)})" if paper else ours for ours, paper in
                            zip(line[2:], (row[f"{error}_paper"] for error in ERRORS))]
        lines.append(line)
    headings = ["", "DB_", "recorded mm", "post.", "rot.", "source mm", "post.", "rot.", "2nd subject mm", "post.", "rot."]
    return source_of(rows) + table(headings, lines, words=2)


def first_results():
    """The two experiments that the paper prints."""
    rows = [row for row in rows_of("figure4") if row["subject"] == "1"]
    lines = []
    for trajectory, database in [("Tr4", "DB_open_power"), ("Tr1", "DB_20_postures")]:
        name = f"{trajectory}, {database}"
        for row in rows:
            if (row["trajectory"], row["database"]) != (trajectory, database):
                continue
            lines.append([name, row["truth"], *(number(row[f"{error}_mean"]) for error in ERRORS),
                          number(row["fingertip_error_mm_mean"]), percent(row["usable"])])
            name = ""
            if row["truth"] == "recorded":
                lines.append(["", "the paper, recorded", *(number(row[f"{error}_paper"]) for error in ERRORS), "", ""])
    headings = ["trajectory, database", "truth", "position mm", "posture deg", "rotation deg", "fingertips mm", "usable %"]
    return source_of(rows) + table(headings, lines, words=2)


def claims():
    """All claims by outcome. Star: required; degree sign: a rule that is ours."""
    rows = rows_of("claims")
    order = ["reproduced", "consistent", "inconclusive", "not consistent", "not reproduced", "withdrawn"]
    lines = []
    for outcome in order:
        of_outcome = [row for row in rows if row["outcome"] == outcome]
        if of_outcome:
            lines.append([f"**{outcome}**", "", ""])
        for row in of_outcome:
            marks = ("* " if row["required"] == "true" else "") + ("° " if row["ours"] == "true" else "")
            value = f"{float(row['value']):.3g}" if row["value"] else ""
            if row["value_low"]:
                value += f" [{float(row['value_low']):.3g}, {float(row['value_high']):.3g}]"
            lines.append([marks + row["id"], f"{value} {row['unit']}".strip(), row["rule"]])
    return table(["claim", "measured", "rule"], lines)


def profiles():
    """Figure 4's experiments with DB_20_postures and the movements as truth, with both profiles."""
    metrics = [*ERRORS, "fingertip_error_mm", "usable_percent"]
    rows = [row for row in rows_of("recommended")
            if row["database"] == "DB_20_postures" and row["truth"].startswith("source")]
    lines = [[row["trajectory"], row["truth"], row["profile"], *(number(row[metric]) for metric in metrics)] for row in rows]
    headings = ["", "truth", "profile", "position mm", "posture deg", "rotation deg", "fingertips mm", "usable %"]
    return table(headings, lines, words=3)


def interval(row, metric):
    """"9.0 [8.1, 9.9]"; the value alone without an interval."""
    low, high = row[metric + "_low"], row[metric + "_high"]
    return number(row[metric], 1) + (f" [{number(low, 1)}, {number(high, 1)}]" if low else "")


def pairs_of_families():
    return zip(rows_of("families_paper"), rows_of("families_recommended"), strict=True)


def families():
    """The suite `families` with both profiles, with Student's intervals over movements."""
    metrics = ["found_percent", "usable_percent", "position_error_mm", "rotation_error_deg", "posture_rms_deg",
               "fingertip_error_mm"]
    lines = []
    for paper, recommended in pairs_of_families():
        lines.append([paper["family"], "paper", *(interval(paper, metric) for metric in metrics)])
        lines.append(["", "recommended", *(interval(recommended, metric) for metric in metrics)])
    headings = ["family", "profile", "found %", "usable %", "position mm", "rotation deg", "posture deg",
                "fingertips mm"]
    return table(headings, lines, words=2)


def families_in_short():
    lines = [[paper["family"], *(f"{number(paper[metric], 1)} / {number(recommended[metric], 1)}"
                                 for metric in ("usable_percent", "position_error_mm", "fingertip_error_mm"))]
             for paper, recommended in pairs_of_families()]
    return table(["family", "usable %", "position mm", "fingertips mm"], lines)


TABLES = {function.__name__: function
          for function in (figure4, first_results, claims, profiles, families, families_in_short)}
