"""Trajectories in multiprecision arithmetic, with more digits than chaos takes away.

heyoka (Biscani and Izzo, MNRAS 504 (2021) 2614) integrates them; nothing else here needs it.
"""
