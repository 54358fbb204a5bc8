"""Models of the Laplacian of pressure; the file name is the option ``scheme.laplacian``.

Each module has one function, ``pair_terms(stencil)``: the coefficients (one, inverse, cubic) of
the pair weight  L(r) = one + inverse/r + cubic/r^3  in  <lap f>_i = sum_j L(r_ij) (f_j - f_i).
"""
