"""Five experiments of two minutes for a class, each with a question and what the run shows."""

from typing import NamedTuple


class Experiment(NamedTuple):
    """The settings of the page (`link`, as in its address), a question, and what the run shows."""

    title: str
    link: str
    question: str
    observation: str


EXPERIMENTS = (
    Experiment(
        title="Stable",
        link="case=fig2_small&omega=8",
        question="The central pair is pushed a little, far from resonance. Where does its motion"
        " go?",
        observation="It leaves as small waves to both sides. At the end the largest amplitudes are"
        " below 40 % of the first one. The ℓ² norms of A and B take turns: while one is large, the"
        " other is small.",
    ),
    Experiment(
        title="Unstable",
        link="case=fig4_small&omega=0&mu=0.1",
        question="The same push at exact resonance. How far does the motion spread, and how large"
        " does it get?",
        observation="The drive feeds a disordered motion that reaches both ends before τ = 20. Then"
        " all pendula swing, the ℓ² norms stay near a level, and no amplitude exceeds 8.",
    ),
    Experiment(
        title="Synchronised",
        link="case=fig4_small&b_re=1",
        question="At the same resonance A and B start alike. What does the drive do now?",
        observation="Nothing: it acts on the difference of A and B, which stays zero. The ℓ² norms"
        " are constant, and small waves leave the centre as in a chain without a drive.",
    ),
    Experiment(
        title="Localised",
        link="case=fig2_large&omega=8",
        question="The central pair is pushed five times as far. Why do its neighbours hardly move?",
        observation="A large swing has a frequency above that of every small wave, so it cannot"
        " radiate. The central pair and its neighbours hold more than half of P to the end.",
    ),
    Experiment(
        title="Chaotic",
        link="case=fig4_large&perturbation=1e-6",
        question="A second run (dashed) starts from initial data that differ by one part in a"
        " million. For how long do the two agree?",
        observation="The curves coincide until about τ = 8, and then have nothing in common. If"
        " they start a million times closer (1e-12), they agree only until about τ = 16.",
    ),
)
