"""The rooms and their arrows as an SVG picture, for scripts/check_layers."""

WIDTH, HEIGHT, GAP_X, GAP_Y, MARGIN = 104, 34, 22, 46, 16


def reduced(arrows):
    """The arrows that do not follow from others: a -> c is left out where a -> b and b reaches c."""
    def reaches(start, goal, skip):
        seen, to_visit = set(), [b for b in arrows[start] if (start, b) != skip]
        while to_visit:
            room = to_visit.pop()
            if room == goal:
                return True
            if room not in seen:
                seen.add(room)
                to_visit += arrows[room]
        return False
    return {a: sorted(b for b in below if not reaches(a, b, (a, b))) for a, below in arrows.items()}


def depths(arrows):
    """How many arrows lead to a room from the top, at most."""
    above = {room: [a for a, below in arrows.items() if room in below] for room in arrows}
    known = {}

    def depth(room):
        if room not in known:
            known[room] = 1 + max((depth(a) for a in above[room]), default=-1)
        return known[room]
    return {room: depth(room) for room in sorted(arrows)}


def svg(arrows):
    """`arrows`: room -> the rooms that it includes. Every room may include base, which is left out."""
    arrows = {room: {b for b in below if b != "base"} for room, below in arrows.items() if room != "base"}
    depth = depths(arrows)
    rows = [[room for room in sorted(arrows) if depth[room] == k] for k in range(max(depth.values()) + 1)]
    widest = max(len(row) for row in rows)
    total = widest * (WIDTH + GAP_X) - GAP_X
    place = {}
    shown = reduced(arrows)
    for r, row in enumerate(rows):
        # Below the middle of those that include it: few arrows cross.
        middle = {room: [place[a][0] for a, below in shown.items() if room in below] for room in row}
        row.sort(key=lambda room: (sum(middle[room]) / len(middle[room]) if middle[room] else 0, room))
        left = MARGIN + (total - len(row) * (WIDTH + GAP_X) + GAP_X) / 2
        for c, room in enumerate(row):
            place[room] = (left + c * (WIDTH + GAP_X), MARGIN + r * (HEIGHT + GAP_Y))
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{total + 2 * MARGIN:g}" '
             f'height="{2 * MARGIN + len(rows) * (HEIGHT + GAP_Y) - GAP_Y:g}" font-family="sans-serif" font-size="13">',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" '
             'orient="auto"><path d="M0,0 L8,4 L0,8 z" fill="#555"/></marker></defs>',
             '<rect width="100%" height="100%" fill="white"/>']
    for room, below in shown.items():
        for other in below:
            (x1, y1), (x2, y2) = place[room], place[other]
            lines.append(f'<line x1="{x1 + WIDTH / 2:g}" y1="{y1 + HEIGHT:g}" x2="{x2 + WIDTH / 2:g}" y2="{y2:g}" '
                         'stroke="#555" marker-end="url(#tip)"/>')
    for room, (x, y) in place.items():
        lines.append(f'<rect x="{x:g}" y="{y:g}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="#eef3f8" stroke="#345"/>')
        lines.append(f'<text x="{x + WIDTH / 2:g}" y="{y + HEIGHT / 2 + 5:g}" text-anchor="middle">{room}</text>')
    return "\n".join([*lines, "</svg>", ""])
