"""Where the tank is cut among ranks."""

from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mpslab.parallel import balance

METHODS = ("static", "centroid", "optimal")
LOADS = st.lists(st.integers(0, 50), min_size=1, max_size=10)


def busiest(load, cuts):
    return max(sum(load[a:b]) for a, b in pairwise(cuts))


def best_of_all(load, ranks):
    """Least load of the busiest rank, by trying every way to cut."""
    n = len(load)
    ways = combinations(range(1, n), ranks - 1)
    return min(busiest(load, [0, *way, n]) for way in ways)


@given(LOADS, st.integers(1, 10))
def test_optimal_cuts_are_as_good_as_the_best_of_all_ways(load, ranks):
    ranks = min(ranks, len(load))
    assert busiest(load, balance.cut("optimal", load, ranks)) == best_of_all(load, ranks)


@given(LOADS, st.integers(1, 10), st.sampled_from(METHODS))
def test_every_rank_owns_a_slab_and_every_slab_has_one_owner(load, ranks, method):
    ranks = min(ranks, len(load))
    if method == "centroid":
        ranks = 2 ** (ranks.bit_length() - 1)
    cuts = balance.cut(method, load, ranks)
    assert len(cuts) == ranks + 1
    assert (cuts[0], cuts[-1]) == (0, len(load))
    assert np.all(np.diff(cuts) >= 1)


def test_static_parts_have_equal_widths_whatever_the_loads():
    assert list(balance.cut("static", [9, 0, 0, 0, 0, 0, 0, 1], 4)) == [0, 2, 4, 6, 8]


def test_centroid_cuts_at_the_centre_of_mass_not_at_the_median():
    load = [10, 10, 10, 1, 1, 1, 1, 1, 1, 1, 1, 1]
    # Mass 39; moment 5 + 15 + 25 + (3.5 + ... + 11.5) = 112.5; centre 2.88.  The median is at 2.
    assert list(balance.cut("centroid", load, 2)) == [0, 3, 12]


def test_centroid_bisects_the_halves_again():
    assert list(balance.cut("centroid", [1] * 8, 8)) == list(range(9))
    load = [4, 4, 4, 4, 1, 1, 1, 1, 1, 1, 1, 1]
    # Centre of all 94/24 = 3.9; of the first four slabs 2, of the other eight 8.
    assert list(balance.cut("centroid", load, 4)) == [0, 2, 4, 8, 12]


def test_centroid_refuses_other_numbers_than_powers_of_two():
    with pytest.raises(ValueError, match=r"ranks = 3: must be a power of two .*centroid"):
        balance.cut("centroid", [1] * 8, 3)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("ranks", [0, 5])
def test_more_ranks_than_slabs_are_refused_with_the_reason(method, ranks):
    with pytest.raises(ValueError, match=f"ranks = {ranks}: must be from 1 to 4, the number of"):
        balance.cut(method, [1, 1, 1, 1], ranks)


@pytest.mark.parametrize("method", METHODS)
def test_slabs_without_load_are_cut_all_the_same(method):
    assert np.all(np.diff(balance.cut(method, np.zeros(9), 4)) >= 1)


def test_imbalance_is_the_busiest_rank_over_the_mean():
    assert balance.imbalance([1, 1, 4, 2], [0, 2, 4]) == pytest.approx(1.5)
    assert balance.imbalance([0, 0], [0, 1, 2]) == 1.0


def test_optimal_balances_a_wedge_of_water_better_than_the_centre_of_mass():
    wedge = np.concatenate([np.full(25, 14.0), np.linspace(14, 4, 50), np.full(25, 4.0)])
    by = {m: balance.imbalance(wedge, balance.cut(m, wedge, 8)) for m in METHODS}
    assert by["optimal"] < 1.07 < by["centroid"] < by["static"]
