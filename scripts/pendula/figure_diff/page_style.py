"""How the page of the comparison looks."""

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; color: #1d2330; margin: 2rem auto; padding: 0 1.5rem;
       max-width: 110rem; }
h1 { font-size: 1.6rem; margin: 0 0 .6rem; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; padding-left: .6rem; border-left: .4rem solid; }
h3 { font-size: 1rem; margin: 1.6rem 0 .1rem; }
h3 + p { margin: 0 0 .5rem; color: #4b5364; }
.tally a { display: inline-block; margin: 0 .4rem .3rem 0; padding: .15rem .7rem;
           border: 1px solid; border-radius: 1rem; text-decoration: none; }
.different, .damaged, .missing, .extra { color: #b3261e; }
.nearly_the_same { color: #8a5a00; }
.identical { color: #20693a; }
.none_of { color: #8b93a3; }
table { border-collapse: collapse; margin: .4rem 0; font-size: .9rem; }
td { padding: .2rem 1.2rem .2rem 0; border-top: 1px solid #e3e6ec; vertical-align: top; }
td:first-child { white-space: nowrap; font-family: ui-monospace, monospace; }
figure { margin: 0; }
figcaption { color: #4b5364; font-size: .85rem; text-align: center; overflow-wrap: anywhere; }
img { max-width: 100%; border: 1px solid #d5d9e2; background: white; }
.three { display: grid; grid-template-columns: repeat(3, 1fr); gap: .8rem; }
.thumbnails { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr));
              gap: 1rem; align-items: start; margin-top: .6rem; }
.none { text-align: center; color: #4b5364; border: 1px dashed #d5d9e2; margin: 0;
        padding: 3rem 0; }
"""
