# Which code a job rests on.
# Snakemake does not see a change in a module that a script imports. So what a job calls stands among
# its parameters with a hash of all code that it rests on.

CALLED = {}


def digest(script):
    """Return a hash of a script below scripts/ with all that it imports."""
    return digest_of_code(SCRIPTS / script)


def function(*names, parts=()):
    """Return the names of functions, and a hash of their code: what a job calls.

    `parts` names modules that they find by the list of studies, such as "paper/claims".
    """
    files = [file for name in names for file in files_of_module(name.rpartition(".")[0])]
    found = [file for part in parts for file in files_of_part(part)]
    files += [path for file in found for path in (file.with_name("__init__.py"), file)]
    CALLED[(*names, *parts)] = files
    return [*names, digest_of_code(*files)]


def name_of(path):
    """Return the name that the claims have for a dataset."""
    return Path(*Path(path).with_suffix("").parts[1:]).as_posix()


def differs_of(wildcards, input):
    """Return in words where the configuration of what a figure shows is not the paper's.

    Of the datasets of many cases it shows those of its trajectories and sweeps, if it has such.
    """
    names = [name_of(path) for path in input if path.endswith(".nc")]
    names = [name for name in names if not name.startswith(("long/", "own/"))]
    own = [name.split("/", 1) for name in names]
    on = [rest for folder, rest in own if folder in ("trajectories", "sweeps")]
    return list(concerning(DIFFERS, names, on).values())


def code_of_jobs():
    """Return the names of all files of code that jobs rest on."""
    files = {module for entries in CALLED.values() for module in modules_of(*entries)}
    return sorted(file.relative_to(PROJECT).as_posix() for file in files)
