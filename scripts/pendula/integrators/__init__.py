"""Time integrators: one file a method, one calling convention. None knows a model.

    build(rates, observe) -> solve
    solve(system, y, times, controls, work, record) -> Outcome

`rates(system, y, dy)` is the right-hand side (Crank-Nicolson takes its mean over a step, Taylor the
rule of a power series instead), `observe(system, y, i, record)` reduces the state at output i.
`work` holds as many arrays of the size of `y` as the module's WORK says. `y` holds pairs of rows
(real and imaginary parts) with one ghost column at each side; it starts as the initial state and
ends as the final one. `times` are those of the outputs, from the start on. Nothing is allocated in
the step loop.

Every explicit method measures errors by the largest component and takes the same steps whether a
solution that is even in n is given whole or by half. Its loop counts outputs by `i`, and steps to
`t_new`, past one output or several, which it interpolates.
"""
