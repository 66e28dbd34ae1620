"""Order conditions of Runge-Kutta methods: one for each rooted tree.

A tree is a smaller tree whose root got one more branch: tree = (trunk, branch), the Butcher product. With the matrix
A of a method its elementary weights at the stages are

    Phi(single node) = 1,   Phi(trunk, branch) = Phi(trunk) * A Phi(branch)     (stage by stage)

and weights b have order p if b . Phi(t) = 1/gamma(t) for all trees t with at most p nodes (Hairer, Norsett, Wanner,
Solving Ordinary Differential Equations I, II.2). Weights b(s) of an interpolant have s^|t| on the right.
"""

from fractions import Fraction
from typing import NamedTuple


class Tree(NamedTuple):
    nodes: int
    # Indices in the list of trees; both None for the single node.
    trunk: int
    branch: int
    # 1/gamma.
    value: Fraction


def trees(order):
    """All rooted trees with at most this many nodes, smaller ones first."""
    found, index = [Tree(1, None, None, Fraction(1))], {(): 0}
    # The branches of each tree, as sorted indices: two trees are equal if these are.
    branches = [()]
    for nodes in range(2, order + 1):
        known = list(range(len(found)))
        for branch in known:
            for trunk in known:
                if found[branch].nodes + found[trunk].nodes != nodes:
                    continue
                key = tuple(sorted([*branches[trunk], branch]))
                if key in index:
                    continue
                index[key] = len(found)
                value = Fraction(1, nodes)
                for child in key:
                    value *= found[child].value
                branches.append(key)
                found.append(Tree(nodes, trunk, branch, value))
    return found


def elementary_weights(found, rows, one):
    """Phi of each tree, for a method with these rows, each a list of (j, a_ij)."""
    phi, moved = [[one] * len(rows)], []
    zero = one - one

    def through(vector):
        return [sum((a * vector[j] for j, a in row), zero) for row in rows]

    moved.append(through(phi[0]))
    last = max((tree.branch for tree in found if tree.branch is not None), default=0)
    for tree in found[1:]:
        phi.append([x * y for x, y in zip(phi[tree.trunk], moved[tree.branch])])
        if len(moved) <= last:
            moved.append(through(phi[-1]))
    return phi
