"""Ends Snakemake with a sentence, and with no line of the rules around it."""

from typing import NoReturn

from snakemake.logging import logger


def stop(reason: object) -> NoReturn:
    """Print why nothing runs, and exit with 1.

    Snakemake would print of any exception where in the rules it was raised, which tells a user
    nothing about their own file.
    """
    logger.error(str(reason))
    raise SystemExit(1)
