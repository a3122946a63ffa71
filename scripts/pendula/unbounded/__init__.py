"""The chain without ends: only its sites in motion are integrated (section 6 of the paper asks).

From the bottom: `window` (the sites in motion), `checkpoint`, `spread` (a long run in pieces),
`members` (ensembles), `linear_front` (the speed of linear spreading), `sea` (the state behind the
front), `powers` (growth laws), `window_map` (maxima over windows), `dataset`, `sizes`.
"""
