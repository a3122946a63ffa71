# Proofs.
def certified_problem(case):
    """Return a case as a problem whose solver is not asked; stop where no bound can be proved.

    A case of the paper that the configuration has changed has an infinite bound then, so that the
    rest of a full run goes on.
    """
    plain = SETTINGS.problem(case, snapshot_step=None)
    if case in OWN_CASES:
        if plain.get("model", "amplitudes") != "amplitudes":
            stop(f"cases.{case}.model: proofs are of curves of the amplitudes, equations (4)")
        try:
            find_form(Constants.of(plain))
        except NotDefiniteError as error:
            stop(f"cases.{case}.omega: {error}")
    return {**plain, "solver": {"name": "polynomials"}}


def short_problem(given):
    short = {"half_width": given.half_width, "end_time": given.end_time}
    return {**certified_problem(given.case), **short}


def proved_curves():
    return below(f"certified/{case}" for case in SETTINGS.certified.curves.cases)


def framed_curves():
    return below(f"certified/{case}" for case in SETTINGS.certified.frames)


def committed_proofs():
    """Return the proofs that are kept; that of a case new in the configuration is made first."""
    proofs = [f"tests/baseline/proofs/{case}.nc" for case in SETTINGS.certified.frames]
    return [committed(proof, "certified") for proof in proofs if is_committed(proof)]


def framed_problem(case):
    from pendula.problem import Problem  # this and the next for a long target alone
    from pendula.studies.certified.fixed_point import NotEvenError, half_chain

    given = SETTINGS.certified.frames[case]
    problem = {**certified_problem(case), "end_time": given.end_time}
    try:
        half_chain(Problem.of(problem), given.bits)
    except NotEvenError as error:
        stop(f"cases.{case}: {error}")
    return problem


def proof_by_frames(case):
    return SETTINGS.certified.frames[case].model_dump(exclude={"end_time"})


def constants_params():
    """Return the cases and the arguments of checks that lead to the constants."""
    given = {
        name: arguments
        for group in GROUPS
        for name, arguments in SETTINGS.theory.arguments(group).items()
        if name in ENCLOSED
    }
    return {
        "names": [f"checks/{name}" for name in ENCLOSED],
        "problems": {case: SETTINGS.problem(case, snapshot_step=None) for case in PAPER_CASES},
        "theory": given,
    }


def known_reference(case):
    return references(case) if case in PAPER_CASES else []


def wrong_curve_params(given):
    made_for = given.model_dump(include={"epsilon", "gamma", "omega"}, exclude_none=True)
    problem = {**certified_problem(given.case), "end_time": given.end_time}
    return {"name": given.case, "problem": problem, "made_for": made_for}
