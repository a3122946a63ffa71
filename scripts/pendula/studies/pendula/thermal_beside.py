"""The thermal state that the sea of the pendula is compared with."""


def thermal_beside(sea, thermal, *names: str):
    """Return these variables of the thermal chain at the sea's Omega, NaN where none was solved."""
    return thermal[list(names)].reindex(omega=[sea.attrs["omega"]]).isel(omega=0, drop=True)
