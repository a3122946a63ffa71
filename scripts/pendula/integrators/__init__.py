"""Time integrators: one file a method, one calling convention.

    solve(rates, observe, system, y, times, controls, record) -> Outcome

`rates(system, y, dy)` is the right-hand side (Crank-Nicolson takes its mean over a step instead),
`observe(system, y, i, record)` reduces the state at output i. `y` holds pairs of rows (real and
imaginary parts) with one ghost column at each side; it starts as the initial state and ends as
the final one. Nothing is allocated in the step loop.
"""
