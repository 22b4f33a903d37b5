"""Visible Surface Discrepancy, by its definition in [HMB18], with the parameters of [HSD20].

    e_VSD = the mean over the pixels p of V̂ ∪ V of  0 if p is in V̂ ∩ V and |Ŝ(p) - S(p)| < τ, else 1

S and Ŝ are distances of the model in the true and in the estimated pose, V and V̂ where it is visible in the image of
distances S_I: by the rule of gt_info.is_visible(), and V̂ also where V is and the estimate has the model.
"""

import numpy as np

from gt_info import is_visible

TAUS = np.arange(1, 11) / 20             # τ, of the diameter; and θ, below which a pose counts as right


def visibilities(true, estimated, measured, delta):
    """V and V̂, H×W of bool, of distances in which 0 is "none"."""
    V = is_visible(true, measured, delta)
    return V, is_visible(estimated, measured, delta) | (V & (estimated > 0))


def vsd(true, estimated, measured, *, delta, taus):
    """e_VSD for each τ, in the unit of the distances; 1 where nothing is visible in either pose."""
    V, V_hat = visibilities(true, estimated, measured, delta)
    both, either = V & V_hat, V | V_hat
    if not either.any():
        return np.ones(len(taus))
    apart, union = np.abs(estimated - true)[both], int(either.sum())
    return np.array([(union - int((apart < tau).sum())) / union for tau in taus])      # rounded once
