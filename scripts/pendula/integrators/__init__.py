"""Time integrators: one file a method, one calling convention.

    build(rates, observe) -> solve
    solve(system, y, times, controls, work, record) -> Outcome

`rates(system, y, dy)` is the right-hand side (Crank-Nicolson takes its mean over a step, Taylor the
rule of a power series instead), `observe(system, y, i, record)` reduces the state at output i.
`work` holds as many arrays of the size of `y` as the module's WORK says. `y` holds pairs of rows
(real and imaginary parts) with one ghost column at each side; it starts as the initial state and
ends as the final one. Nothing is allocated in the step loop. `taylor_batch`, which takes many runs
at once, says itself how it is called.
"""
