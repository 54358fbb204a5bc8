"""Every figure and table of the paper, made again from runs of mpslab: ``python -m paper_figures``.

The paper: Gotoh, Khayyer, Ikari & Hori, Development of 3D Parallelized CMPS Method with Optimized
Domain Decomposition.
"""
