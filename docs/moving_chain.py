"""The animation at the top of the README: the pendula of Fig 4, with small initial amplitudes.

An animated SVG needs no script, is sharp at any size, and has a tenth of the size of a video.
"""

import numpy as np
from latticode.simulation.simulate import simulate
from pendula.notebook import Case
from pendula.problem import PaperProblem

SHOWN_SITES = range(-10, 11)
END_TIME = 14.0
"""The time tau at which all shown sites are in motion; one unit of tau takes a second."""
FRAMES_PER_SECOND = 12
MU = 0.09
"""The small parameter that scales the angles; with it no pendulum goes over the top."""
ROD, GAP = 46, 36
COLOURS = {"A": "#c0392b", "B": "#1b4fd1"}
HEAD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} 190" role="img">
<title>A chain of pendulum pairs at Omega = 0: a push at the centre grows and spreads</title>
<style>line {{ stroke: #888; stroke-width: 1.5 }} text {{ font: 20px sans-serif }}</style>
"""
PENDULUM = """<g transform="translate({x} {y})"><g><line y2="{rod}"/>\
<circle cy="{rod}" r="6" fill="{colour}"/><animateTransform attributeName="transform" \
type="rotate" dur="{seconds}s" repeatCount="indefinite" values="{angles}"/></g></g>
"""


def swing_angles() -> np.ndarray:
    """Return the angle of each pendulum in degrees, (frame, component, shown site).

    By (3) an amplitude A gives the angle 2 mu Re(A exp(i phase)). An oscillation takes a second.
    """
    case = Case(omega=0.0, initial={0: [1.0, 0.1]}, solver="taylor")
    problem = PaperProblem.of(case.shown_problem()).changed(snapshot_every=0)
    centre = problem.half_width
    frames = np.arange(1, round(END_TIME * FRAMES_PER_SECOND) + 1) / FRAMES_PER_SECOND
    states = [simulate(problem.changed(end_time=t, output_step=t)).final for t in frames]
    shown = np.array([problem.amplitudes, *states])[:, :, [centre + n for n in SHOWN_SITES]]
    phase = 2.0 * np.pi * np.concatenate([[0.0], frames])[:, None, None]
    return np.degrees(2.0 * MU * (shown.real * np.cos(phase) - shown.imag * np.sin(phase)))


def draw() -> str:
    """Return the picture as SVG."""
    angles = np.round(-swing_angles()).astype(int)  # a positive angle goes to the right
    pieces = [HEAD.format(width=60 + GAP * len(SHOWN_SITES))]
    for component, (name, colour) in enumerate(COLOURS.items()):
        y = 15 + 95 * component
        pieces.append(f'<text x="8" y="{y + 30}" fill="{colour}">{name}</text>\n')
        pieces += [
            PENDULUM.format(
                x=50 + GAP * place,
                y=y,
                rod=ROD,
                colour=colour,
                seconds=END_TIME,
                angles=";".join(map(str, angles[:, component, place])),
            )
            for place in range(len(SHOWN_SITES))
        ]
    return "".join([*pieces, "</svg>\n"])
