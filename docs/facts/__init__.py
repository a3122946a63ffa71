"""Every number that the README and docs/ quote, as text, read from the datasets in tests/baseline.

A module holds the topics that belong together. A function stands for a topic, and its facts are
named after what they are: a template says `{{ chaos.rates }}`. No number is typed here. Arguments
such as a time or a site say where in a dataset a number stands; the text around the fact names them
as well.
"""
