"""Rooted trees and the order conditions of Runge-Kutta methods (Butcher).

A method with the matrix `a` has order p when sum(b * weights(tree)) = 1 / density(tree) for every
rooted tree of at most p nodes. A tree is the sorted tuple of the trees that hang on its root.
"""

from functools import cache
from math import prod

import numpy as np


@cache
def trees(order):
    """Return all rooted trees of `order` nodes."""
    if order == 1:
        return [()]
    grown = {
        tuple(sorted((*trunk, branch)))
        for size in range(1, order)
        for trunk in trees(order - size)
        for branch in trees(size)
    }
    return sorted(grown)


def nodes(tree):
    """Return the number of nodes of a tree."""
    return 1 + sum(nodes(branch) for branch in tree)


def density(tree):
    """Return gamma(t), the product of the sizes of all subtrees."""
    return nodes(tree) * prod(density(branch) for branch in tree)


def weights(tree, a):
    """Return the elementary weight of the tree at every stage."""
    result = np.ones(len(a))
    for branch in tree:
        result = result * (a @ weights(branch, a))
    return result


def defect(a, b, order, fraction=1.0, expected=1.0):
    """Return the largest failure of a condition up to `order`, at a fraction of the step.

    `expected` = 0 asks what an error estimate must satisfy: to vanish up to that order.
    """
    return max(
        abs(b @ weights(tree, a) - expected * fraction**n / density(tree))
        for n in range(1, order + 1)
        for tree in trees(n)
    )
