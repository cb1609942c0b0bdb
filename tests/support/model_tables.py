"""Tables for every encoding: facts, and the models that they have."""

from __future__ import annotations

from support.models import Case

ONION = (
    'object(1..4). label(1,"bowl"). content(1,"contains","onion"). '
    'label(2,"onion"). relation(2,"in","bowl"). '
    'label(3,"knife"). label(4,"onion"). state(4,"chopped"). utensil("bowl"). '
)
"""1 is a bowl with an onion in it, 2 the onion in the bowl, 3 a bare knife, 4 a chopped onion."""

ORDERS = (
    'listed("state",1,0,"whole"). listed("state",1,1,"peeled"). listed("state",1,2,"diced"). '
    'object(1..4). label(1..4,"onion"). state(1,"whole"). '
    'state(2,"diced"). state(3,"shiny"). state(4,"whole"). '
)
"""Onions are peeled and then diced; no order says anything of shiny ones."""

CUT = ONION + "unit(7). input(7,(1;2;3)). output(7,(3;4)). "

COOK = (
    "unit(beat). unit(bake). unit(fry). object((egg;batter;cake;waffle)). kitchen(egg). "
    "state((egg;batter;cake;waffle),s). input(beat,egg). output(beat,batter). input((bake;fry),batter). "
    "output(bake,cake). output(fry,waffle). shortest((beat;bake;fry),2). head(beat,0). head((bake;fry),1). "
    "tail(beat,1). tail((bake;fry),0). window(0,0). "
)
"""Batter is beaten of an egg, and baked or fried; each takes a second."""

TWICE = (
    "goal(cake). goal(waffle). worker(cook,1). able((beat;bake;fry),cook,1,1). most((beat;bake;fry),2). "
    "quickest((beat;bake;fry),1). "
)
"""One cook, with one hand, is to make both."""

READINGS = (
    Case("vocabulary.lp", "it derives nothing", CUT, "needs/2 makes/2 unit/1", ("unit(7)",)),
    Case(
        "units.lp",
        "an implied view is not needed, a bare output that an input is, too, is not made",
        CUT,
        "needs/2 makes/2",
        ("makes(7,4) needs(7,2) needs(7,3)",),
    ),
    Case(
        "units.lp",
        "strict: every input is needed",
        CUT,
        "needs/2",
        ("needs(7,1) needs(7,2) needs(7,3)",),
        constants="strict=1",
    ),
    Case(
        "units.lp",
        "loosely, what is on the bowl is in it, and one object counts as another",
        CUT.replace('"in"', '"on"') + "counts_as(4,1).",
        "needs/2 makes/2",
        ("makes(7,1) needs(7,2) needs(7,3)",),
        constants="loose=1",
    ),
    Case(
        "units.lp",
        "a bare output is made if it is no utensil, and no input has its label",
        'object(1..5). label(1,"ice"). state(1,"hard"). label(2,"ice"). label(3,"bowl"). label(4,"juice"). '
        'label(5,"bowl"). state(5,"cold"). utensil("bowl"). unit(7). input(7,1). output(7,2..5).',
        "makes/2",
        ("makes(7,4) makes(7,5)",),
    ),
    Case(
        "units.lp",
        "labels alone: every output is made",
        CUT,
        "makes/2 bare/1",
        ("bare(3) makes(7,3) makes(7,4)",),
        constants="labels_only=1",
    ),
    Case(
        "mentioning.lp",
        "an object mentions its label, its relatum and its contents",
        ONION,
        "mentions/2",
        (
            'mentions(1,"bowl") mentions(1,"onion") mentions(2,"bowl") mentions(2,"onion")'
            ' mentions(3,"knife") mentions(4,"onion")',
        ),
    ),
    Case(
        "touching.lp",
        "a unit handles what it lists and what that is in, and touches what is in it",
        ONION + "unit(7). input(7,1). output(7,3).",
        "lists/2 handles/2 touches/2",
        (
            'handles(7,"bowl") handles(7,"knife") lists(7,1) lists(7,3)'
            ' touches(7,"bowl") touches(7,"knife") touches(7,"onion")',
        ),
    ),
    Case("consumption.lp", "add: nothing is used up", CUT + "kitchen(1..3).", "deletes/2", ("",)),
    Case(
        "consumption.lp",
        "consume: inputs that are no outputs are used up, but not what is there in plenty",
        CUT + "kitchen(1..3). quantity(1,2).",
        "deletes/2 endless/1",
        ("deletes(7,1) endless(2) endless(3)",),
        constants="semantics=consume",
    ),
    Case(
        "consumption.lp",
        "transform: the onion turns up again, the bowl does not",
        CUT + "kitchen(3).",
        "deletes/2",
        ("deletes(7,2)",),
        constants="semantics=transform",
    ),
    Case(
        "worlds.lp",
        "each world has its own things and units",
        "at_first(rich,(flour;salt)). at_first(poor,flour). may((rich;poor),bake). may(rich,fry).",
        "available/2 executable/2",
        (
            "available(poor,bread) available(poor,flour) available(rich,bread) available(rich,chips)"
            " available(rich,flour) available(rich,salt) executable(poor,bake) executable(rich,bake)"
            " executable(rich,fry)",
        ),
        recipes="bake: flour -> bread; fry: salt -> chips",
    ),
    Case(
        "reachability.lp",
        "a circle never starts itself, a unit without needs does",
        "kitchen(flour).",
        "available/1 executable/1",
        ("available(flour) available(water) executable(rain)",),
        recipes="rain: -> water; go: a, water -> b; back: b -> a",
    ),
    Case(
        "ask.lp",
        "readings, reachability and labels are there at once",
        CUT + "kitchen(2..3).",
        "available/1 executable/1 touches/2",
        (
            'available(2) available(3) available(4) executable(7) touches(7,"bowl") touches(7,"knife")'
            ' touches(7,"onion")',
        ),
    ),
)

BREAD = "bake: flour -> bread; fry: salt -> bread; toast: bread -> toast"
TOAST = "kitchen((flour;salt)). goal(toast)."
TREE = ("retrieval/task_tree.lp",)
CIRCLE = "go: a -> b; back: b -> a; end: b -> goal"
NUMBERED = "1: flour -> bread; 2: salt -> bread; 3: bread -> toast"
"""The same as BREAD, in the order of a file."""

MENDED = (
    'object(1..4). label(1..4,"egg"). state(1,"whole"). state(2,"raw"). state(3,"beaten"). state(4,"fried"). '
    "kitchen(1). goal(4). "
)
WHISK = "unit(0). input(0,2). output(0,3). "
CRACK, BEAT, FRY = (
    f'step({{step}}). listed({{step}},"input",{one}). listed({{step}},"output",{other}). '
    for one, other in ((1, 2), (2, 3), (3, 4))
)
MENDS = "moved/1 removed/1 inserted/2 changed/4"

RETRIEVAL = (
    Case(
        "retrieval/task_tree.lp",
        "all sets of units that make the goal are trees",
        TOAST,
        "use/1",
        ("use(bake) use(fry) use(toast)", "use(bake) use(toast)", "use(fry) use(toast)"),
        recipes=BREAD,
    ),
    Case("retrieval/task_tree.lp", "no circle holds itself up", "goal(goal).", "use/1", (), recipes=CIRCLE),
    Case(
        "retrieval/task_tree.lp",
        "but it does without foundedness",
        "goal(goal).",
        "use/1",
        ("use(back) use(end) use(go)",),
        recipes=CIRCLE,
        constants="founded=0",
    ),
    Case(
        "retrieval/selection.lp",
        "one unit for each object",
        TOAST,
        "pick/2",
        ("pick(bread,bake) pick(toast,toast)", "pick(bread,fry) pick(toast,toast)"),
        recipes=BREAD,
    ),
    Case(
        "retrieval/selection.lp",
        "what is made on the side does not count",
        "goal((yolk;cake)). kitchen(egg).",
        "pick/2",
        ("pick(cake,bake) pick(white,part) pick(yolk,part)",),
        recipes="part: egg -> yolk, white; bake: white, yolk -> cake, yolk",
    ),
    Case(
        "retrieval/greedy.lp",
        "the highest rate near the goal comes first, whatever it costs further away",
        "kitchen(a). goal(goal). "
        "success_rate(1,900). success_rate(2,800). success_rate(3,100). success_rate(4,999).",
        "use/1 beyond/1",
        ("use(1) use(3)",),
        recipes="1: x -> goal; 2: y -> goal; 3: a -> x; 4: a -> y",
        constants="by=success horizon=3",
    ),
    Case(
        "retrieval/greedy.lp",
        "alike units: the first in the file; too small a horizon is said",
        TOAST,
        "use/1 beyond/1",
        ("beyond(bread) use(1) use(3)", "beyond(bread) use(2) use(3)"),
        recipes=NUMBERED,
        constants="by=first horizon=0",
    ),
    Case(
        "retrieval/greedy.lp",
        "within the horizon the first unit is taken",
        TOAST,
        "use/1 beyond/1",
        ("use(1) use(3)",),
        recipes=NUMBERED,
        constants="by=first horizon=1",
    ),
    Case(
        "retrieval/ids.lp",
        "a bound below the depth of the goal has no model",
        TOAST,
        "use/1",
        (),
        recipes=NUMBERED,
        parts=(("check", 0), ("step", 1), ("check", 1)),
        on="bound(1)",
    ),
    Case(
        "retrieval/ids.lp",
        "at the first bound each object takes its first unit",
        TOAST,
        "pick/2 use/1",
        ("pick(bread,1) pick(toast,3) use(1) use(3)",),
        recipes=NUMBERED,
        parts=(("check", 0), ("step", 1), ("check", 1), ("step", 2), ("check", 2), ("choose", 2)),
        on="bound(2)",
    ),
    Case(
        "retrieval/ids.lp",
        "a goal that is at hand takes no unit",
        "kitchen(bread). goal(bread).",
        "pick/2 use/1",
        ("",),
        recipes=NUMBERED,
        parts=(("check", 0), ("choose", 0)),
        on="bound(0)",
    ),
    Case(
        "retrieval/ids.lp",
        "the long way stands first, but does not fit",
        "kitchen(a). goal(goal).",
        "use/1",
        ("use(4) use(5)",),
        recipes="1: a -> b; 2: b -> c; 3: c -> part; 4: a -> part; 5: part -> goal",
        parts=(("step", 1), ("step", 2), ("check", 2), ("choose", 2)),
        on="bound(2)",
    ),
    Case(
        "retrieval/alternatives.lp",
        "neither a known tree nor more than one",
        TOAST + "known(0,(bake;toast)).",
        "use/1",
        ("use(fry) use(toast)",),
        recipes=BREAD,
        beside=TREE,
    ),
    Case(
        "retrieval/diverse.lp",
        "the tree that shares least comes before the cheaper one, within the limit",
        'kitchen(a). goal(goal). known(0,(one;two)). limit(1,3). criterion("units",1).',
        "use/1",
        ("use(four) use(five) use(six)",),
        recipes="one: a -> b; two: b -> goal; three: b -> goal; four: a -> c; five: c -> d; six: d -> goal",
        beside=("retrieval/task_tree.lp", "criteria/units.lp"),
    ),
    Case(
        "retrieval/diverse.lp",
        "beyond the limit it does not count",
        'kitchen(a). goal(goal). known(0,(one;two)). limit(1,2). criterion("units",1).',
        "use/1",
        ("use(one) use(three)",),
        recipes="one: a -> b; two: b -> goal; three: b -> goal; four: a -> c; five: c -> d; six: d -> goal",
        beside=("retrieval/task_tree.lp", "criteria/units.lp"),
    ),
    Case(
        "retrieval/pareto.lp",
        "a tree that is better by one of the criteria than the known trade-off",
        'kitchen(a). goal(goal). motion((one;two),"mix"). motion(three,"fry"). motion(four,"cut"). '
        'criterion("units",2). criterion("motions",1). point(0,2,2). point(0,1,2).',
        "use/1 no_better/2",
        ("no_better(0,2) use(one) use(two)",),
        recipes="one: a -> b; two: b -> goal; three: a -> c; four: c -> goal",
        beside=("retrieval/task_tree.lp", "criteria/units.lp", "criteria/motions.lp"),
    ),
    Case(
        "retrieval/suggest.lp",
        "a tree that takes egg in vain is none that is made with egg",
        'kitchen((egg;flour)). goal(bread). using("egg"). label(egg,"egg"). input(plain,flour). '
        "input(rich,(egg;flour)). input(beat,egg).",
        "use/1",
        ("use(beat) use(rich)", "use(rich)"),
        recipes="plain: flour -> bread; rich: egg, flour -> bread; beat: egg -> foam",
    ),
    Case(
        "retrieval/likely.lp",
        "the step that changes what is at hand, with the fewest tools; none where food is lacking",
        ONION
        + "unit(1..4). input(1,(1;2)). output(1,4). input(2,(2;3)). output(2,4). input(3,5). output(3,4)."
        ' input(4,5). output(4,6). object(5..6). label(5,"egg"). state(5,"raw"). label(6,"cake").'
        ' state(6,"baked"). gap(0,4). there(0,(2;5)). gap(1,4). there(1,5). gap(2,6).',
        "closes/2",
        ("closes(0,1) closes(1,3)",),
    ),
    Case(
        "retrieval/edits.lp",
        "what an object is changed to is listed instead of it; all else stays as it is",
        MENDED
        + CRACK.format(step=11)
        + BEAT.format(step=12)
        + 'variant(2,3,1). :- not changed(11,"output",2,3).',
        "input/2 output/2 stays/1",
        ("input(11,1) input(12,2) output(11,3) output(12,3) stays(11) stays(12)",),
    ),
    Case(
        "retrieval/mend.lp",
        "a step that comes too early is moved, the first one where several would do",
        MENDED + CRACK.format(step=12) + BEAT.format(step=11) + FRY.format(step=13),
        MENDS,
        ("moved(11)",),
    ),
    Case(
        "retrieval/mend.lp",
        "a known step is inserted where one lacks",
        MENDED + CRACK.format(step=11) + FRY.format(step=12) + WHISK,
        MENDS,
        ("inserted(0,0)",),
    ),
    Case(
        "retrieval/mend.lp",
        "with as many edits, no step is inserted",
        MENDED + CRACK.format(step=11) + FRY.format(step=12) + WHISK + "variant(3,2,1).",
        MENDS,
        ('changed(12,"input",3,2)',),
    ),
    Case(
        "retrieval/mend.lp",
        "a step that comes too early and comes again is rather moved than removed",
        MENDED + FRY.format(step=11) + CRACK.format(step=12) + BEAT.format(step=13) + FRY.format(step=14),
        MENDS,
        ("moved(11)",),
    ),
    Case(
        "retrieval/mend_in_order.lp",
        "what is used up is made again, between the two steps that take it",
        MENDED
        + "goal(3). unit(0). input(0,1). output(0,2). "
        + CRACK.format(step=11)
        + BEAT.format(step=12)
        + 'step(13). listed(13,"input",2). listed(13,"output",4).',
        MENDS,
        ("inserted(0,3)",),
        constants="semantics=consume horizon=4",
        parts=(*(("step", time) for time in range(1, 5)), ("whole", 4)),
    ),
    Case(
        "retrieval/mend_in_order.lp",
        "without a time for it nothing is inserted",
        MENDED + CRACK.format(step=11) + FRY.format(step=12) + WHISK,
        MENDS,
        (),
        constants="horizon=2",
        parts=(("step", 1), ("step", 2), ("whole", 2)),
    ),
    Case(
        "retrieval/transitions.lp",
        "a known state comes behind a known one that leads to it; what no order has may come as it likes",
        ORDERS + "unit(1..4). input(1,1). output(1,2). input(2,2). output(2,1). input(3,1). output(3,3)."
        " input(4,3). output(4,(2;4)). step(I,0,I) :- unit(I).",
        "refused/4",
        ('refused(2,"state","onion","whole")',),
    ),
    Case(
        "retrieval/transitions.lp",
        "where words must be adjacent none is left out",
        ORDERS + "unit(1). input(1,1). output(1,2). step(1,0,1).",
        "refused/4",
        ('refused(1,"state","onion","diced")',),
        constants="adjacent=1",
    ),
    Case(
        "retrieval/transitions.lp",
        "motions follow each other from step to step of a tree",
        'listed("motion",1,0,"cut"). listed("motion",1,1,"fry"). step(1,0,7). step(2,0,8). step(3,0,9).'
        ' motion(7,"fry"). motion(8,"cut"). motion(9,"wash"). handed(1,2,"onion"). handed(2,3,"onion").',
        "refused/4",
        ('refused(2,"motion","onion","cut")',),
    ),
    Case(
        "retrieval/substitute.lp",
        "what stands for the missing object is at hand if its label is replaced, by one label and no further",
        'goal(soup). stored(cream). names(cream,"cream"). match(1,milk,cream). differs(1,"milk","cream"). '
        'alike("milk","cream",100). alike("cream","oil",1). brings(stir,"milk").',
        "replace/2 use/1",
        ('replace("milk","cream") use(cook)',),
        recipes="cook: milk -> soup; stir: cook -> soup",
    ),
    Case(
        "retrieval/substitute.lp",
        "what the tree itself makes of other things gets no other name, but may be left out",
        'goal(soup). kitchen(egg). called(mayo,"mayo"). alike("mayo",("cream";nothing),200). '
        'brings(stir,"mayo"). :- not use(stir).',
        "replace/2",
        ('replace("mayo",nothing)', ""),
        recipes="stir: egg -> mayo; cook: mayo -> soup",
    ),
    Case(
        "criteria/likeness.lp",
        "each label that is replaced costs once, before all else",
        '1 { replace("milk",(cream;oil)); replace("egg",oil) } 1. alike("milk",cream,100). '
        'alike("milk",oil,300). alike("egg",oil,200). criterion("units",5). penalty("units",1,9).',
        "replace/2",
        ('replace("milk",cream)',),
    ),
    Case(
        "retrieval/adapt.lp",
        "what is wanted replaces what must go, or is added beside what stays, in a tree that needs it",
        'goal(soup). wanted("oat";"rye"). stored(milk). names(milk,"milk"). kitchen(nut). label(nut,"nut"). '
        'label(milk,"milk"). alike("milk","oat",300). near("nut","rye",300). :- not replace("milk",_).',
        "replace/2 beside/2 absent/1 use/1",
        ('beside("rye","nut") replace("milk","oat") use(cook) use(stir)',),
        recipes="stir: nut -> paste; cook: paste, milk -> soup; toast: nut -> soup",
    ),
    Case(
        "retrieval/adapt.lp",
        "what need not go stays, and what is wanted is added beside it",
        'goal(soup). wanted("oat"). stored(milk). names(milk,"milk"). label(milk,"milk"). '
        'alike("milk","oat",300). near("milk","oat",300).',
        "replace/2 beside/2 absent/1 use/1",
        ('beside("oat","milk") use(cook)',),
        recipes="cook: milk -> soup",
    ),
    Case(
        "retrieval/adapt.lp",
        "nothing is added beside what only replaces something",
        'goal(soup). wanted("rye"). label(milk,"milk"). stored(oat). label(oat,"oat"). near("oat","rye",1). '
        'alike("milk","oat",300). match(1,milk,oat). differs(1,"milk","oat").',
        "replace/2 beside/2 absent/1 use/1",
        ('absent("rye") replace("milk","oat") use(cook)',),
        recipes="cook: milk -> soup",
    ),
    Case(
        "retrieval/missing.lp",
        "raw things come before prepared ones, and few before many",
        'goal(soup). label(soup,"soup"). label(stock,"stock"). label((bone;water;salt),"raw").',
        "missing/1",
        ("missing(bone) missing(water)",),
        recipes="simmer: bone, water -> stock; cook: stock -> soup",
    ),
    Case(
        "retrieval/missing.lp",
        "the dish in another guise helps only where nothing else does",
        'goal(soup). label((soup;frozen),"soup"). state(frozen,"frozen").',
        "missing/1 same_dish/1",
        ("missing(frozen) same_dish(frozen) same_dish(soup)",),
        recipes="thaw: frozen -> soup",
    ),
)

PAIR = "kitchen(a). goal(goal). "
SHORT_OR_LONG = "short: a -> goal; one: a -> b; two: b -> goal"
RATES = "fails(short,139). fails((one;two),69). "

CRITERIA = (
    Case(
        "criteria/objective.lp",
        "higher priorities first; what is not asked costs nothing",
        '{ p; q } = 1. criterion("x",2). criterion("y",1). '
        'penalty("x",k,1) :- p. penalty("y",k,9) :- q. penalty("z",k,99) :- q.',
        "p/0 q/0",
        ("q",),
    ),
    Case(
        "criteria/objective.lp",
        "nothing comes before the foremost",
        '{ p; q } = 1. criterion("x",2147483647). foremost("ours"). '
        'penalty("x",k,9) :- p. penalty("ours",k,1) :- q.',
        "p/0 q/0",
        ("p",),
    ),
    Case(
        "criteria/objective.lp",
        "a sum of criteria, with factors",
        '{ p; q } = 1. criterion("x",1). criterion("y",1). factor("x",3). '
        'penalty("x",k,1) :- p. penalty("y",k,2) :- q.',
        "p/0 q/0",
        ("q",),
    ),
    Case(
        "criteria/rounds.lp",
        "what is at hand, and what is executed, after each round",
        PAIR + "use((one;two)).",
        "at_hand_by/2 done_by/2 late/1 too_deep/1",
        (
            "late(0) late(1) at_hand_by(a,0) at_hand_by(a,1) at_hand_by(a,2) at_hand_by(b,1) at_hand_by(b,2)"
            " at_hand_by(goal,2) done_by(one,1) done_by(one,2) done_by(two,2)",
        ),
        recipes=SHORT_OR_LONG,
        constants="horizon=2",
    ),
    Case(
        "criteria/rounds.lp",
        "it says if the horizon is too small",
        PAIR + "use((one;two)).",
        "late/1 too_deep/1",
        ("late(0) late(1) too_deep(1)",),
        recipes=SHORT_OR_LONG,
    ),
    Case(
        "criteria/rounds.lp",
        "what is beside the way to the goal takes its rounds, too",
        PAIR + "use((short;one;side;end)).",
        "late/1 too_deep/1",
        ("late(0) late(1) late(2)",),
        recipes=SHORT_OR_LONG + "; side: b -> rest; end: rest -> more",
        constants="horizon=3",
    ),
    Case(
        "criteria/takeover.lp",
        "the human may do any step of the tree, and no other",
        "unit((one;two;three)). use((one;two)).",
        "human/1",
        ("", "human(one)", "human(one) human(two)", "human(two)"),
    ),
    Case(
        "criteria/units.lp",
        "the fewest units",
        PAIR + 'criterion("units",1).',
        "use/1 penalty/3",
        ('use(short) penalty("units",short,1)',),
        recipes=SHORT_OR_LONG,
        beside=TREE,
    ),
    Case(
        "criteria/depth.lp",
        "the fewest rounds, however many units that takes",
        PAIR + 'criterion("depth",2). criterion("units",1).',
        "use/1",
        ("use(four) use(left) use(right) use(up)",),
        recipes="left: a -> x; right: a -> y; up: a -> z; four: x, y, z -> goal;"
        " one: a -> b; two: b -> c; three: c -> goal",
        beside=(*TREE, "criteria/units.lp"),
        constants="horizon=3",
    ),
    Case(
        "criteria/inputs.lp",
        "the fewest inputs, tools too",
        PAIR + "input(short,(a;t1;t2)). input(one,a). input(two,b). " + 'criterion("inputs",1).',
        "use/1",
        ("use(one) use(two)",),
        recipes=SHORT_OR_LONG,
        beside=TREE,
    ),
    Case(
        "criteria/motions.lp",
        "a motion that is made twice counts once",
        'use((1;2;3)). motion((1;2),"mix"). motion(3,"fry").',
        "penalty/3",
        ('penalty("motions","fry",1) penalty("motions","mix",1)',),
    ),
    Case(
        "criteria/cost.lp",
        "each unit pays for its motion, one without a cost nothing",
        "use((1;2;3)). costs(1,7). costs(2,7). costs(4,1).",
        "penalty/3",
        ('penalty("cost",1,7) penalty("cost",2,7)',),
    ),
    Case(
        "criteria/time.lp",
        "seconds, of what is used and where they are known",
        "use((1;2)). duration(1,4). duration(3,9).",
        "penalty/3",
        ('penalty("time",1,4)',),
    ),
    Case(
        "criteria/tools.lp",
        "a utensil that is handled twice counts once, a knife that is no utensil not at all",
        ONION + "use((7;8)). input(7,(1;3)). input(8,2).",
        "penalty/3",
        ('penalty("tools","bowl",1)',),
    ),
    Case(
        "criteria/dirty.lp",
        "only a utensil that holds something gets dirty",
        ONION + 'object(5..6). label(5,"bowl"). state(5,"empty"). label(6,"pot"). utensil("pot"). '
        "use((7;8;9)). input(7,1). output(8,2). input(9,(5;6)).",
        "penalty/3 holds/2",
        ('holds(7,"bowl") holds(8,"bowl") penalty("dirty","bowl",1)',),
    ),
    Case(
        "criteria/human.lp",
        "a human does as little as a limit of failures allows",
        'unit((1;2)). use((1;2)). fails(1,69). fails(2,11). max_failure("",20). criterion("human",1).',
        "human/1",
        ("human(1)",),
        beside=("constraints/constraints.lp",),
    ),
    Case(
        "criteria/failures.lp",
        "without a human each step pays for itself",
        RATES + "use((one;two;short)).",
        "failure/2 split/1",
        ("failure(one,69) failure(short,139) failure(two,69)",),
    ),
    Case(
        "criteria/failures.lp",
        "with one human step the dearest is free: of 139, 69 and 69 two steps pay the 69 below all",
        RATES + 'use((one;two;short)). human_steps("",1).',
        "failure/2 split/1",
        ("split(1) failure((69,2),69) failure((69,3),69)",),
    ),
    Case(
        "criteria/failures.lp",
        "with two dear steps the second pays the part between 69 and 139, too",
        RATES + 'fails(long,139). use((long;short;one)). human_steps("",1).',
        "failure/2",
        ("failure((69,2),69) failure((69,3),69) failure((139,2),70)",),
    ),
    Case(
        "criteria/failures.lp",
        "where it is open what the human does there is no split",
        RATES + 'use((one;two)). human_steps("",1). open_to_human(one). human(one).',
        "failure/2 split/1",
        ("failure(two,69)",),
    ),
    Case(
        "criteria/success.lp",
        "two steps of a half are as likely to succeed as one of a quarter, and cost one less by rounding",
        PAIR + RATES + 'criterion("success",1).',
        "use/1 penalty/3",
        ('use(one) use(two) penalty("success",one,69) penalty("success",two,69)',),
        recipes=SHORT_OR_LONG,
        beside=TREE,
    ),
)

BROKEN = (
    'use((7;8)). input(7,1). input(8,3). motion(7,"pour"). motion(8,"cut"). '
    "fails((7;8),69). human(7). late(0..2). "
)

OTHERS = (
    Case(
        "constraints/constraints.lp",
        "each constraint is broken where it says, and those that hold are not",
        ONION + BROKEN + 'without("onion","onion"). without("fish","fish"). without_tool("knife","knife"). '
        'without_tool("onionless","onion"). avoid_motion("pour","pour"). only_motion("cut","cut"). '
        'use_unit("use",(7;9)). avoid_unit("avoid",(8;9)). max_units("one",1). max_units("two",2). '
        'max_depth("flat",2). max_depth("deep",3). max_failure("safe",68). max_failure("risky",69). '
        'human_steps("none",0). human_steps("some",1). waived(Name) :- violated(Name,_).',
        "violated/2",
        (
            'violated("avoid",8) violated("cut",7) violated("flat",2) violated("knife",8)'
            ' violated("none",0) violated("one",1) violated("onion",7) violated("pour",7)'
            ' violated("safe",68) violated("use",9)',
        ),
    ),
    Case(
        "constraints/constraints.lp",
        "what is broken and not waived leaves no model",
        BROKEN + 'avoid_motion("pour","pour").',
        "violated/2",
        (),
    ),
    Case(
        "constraints/conflict.lp",
        "as few constraints as possible give way",
        PAIR + 'avoid_unit("a",one). avoid_unit("b",two). avoid_unit("c",short).',
        "waived/1 use/1",
        ('waived("c") use(short)',),
        recipes=SHORT_OR_LONG,
        beside=(*TREE, "constraints/constraints.lp"),
    ),
    Case(
        "constraints/conflict.lp",
        "several sets may be as small",
        PAIR + 'avoid_unit("a",one). avoid_unit("c",short).',
        "waived/1",
        ('waived("a")', 'waived("c")'),
        recipes=SHORT_OR_LONG,
        beside=(*TREE, "constraints/constraints.lp"),
    ),
    Case(
        "progression.lp",
        "a product is used up before what the kitchen holds",
        "kitchen(a). kitchen(b). quantity(b,1). input(two,b). object((a;b;c)). state((a;b;c),s)."
        " do(one,1). do(two,2).",
        "has/2",
        ("has(a,0) has(a,1) has(a,2) has(b,0) has(b,1) has(b,2) has(c,2)",),
        recipes="one: a -> b; two: b -> c",
        constants="semantics=consume",
        parts=(("step", 1), ("step", 2)),
    ),
    Case(
        "retrieval/order.lp",
        "what is used up is used when nobody needs it any more, and a step that comes twice is done twice",
        "kitchen(a). quantity(a,1). input((one;two),a). output(one,a). object((a;b;c)). state((a;b;c),s)."
        " times(one,2). times(two,1).",
        "do/2",
        ("do(one,1) do(one,2) do(two,3)",),
        recipes="one: a -> b; two: a -> c",
        constants="semantics=consume",
        parts=(("step", 1), ("step", 2), ("step", 3), ("whole", 3)),
    ),
    Case(
        "planning/plan.lp",
        "two units that need no more than the kitchen are done at once, or more often, if nothing is pruned",
        "kitchen(a). goal(b). goal(c).",
        "do/2",
        ("do(one,1) do(two,1)",),
        recipes="one: a -> b; two: a -> c",
        parts=(("step", 1), ("check", 1), ("cheapest", 1)),
        on="last(1)",
    ),
    Case(
        "planning/plan.lp",
        "what is there once can be used up once: no plan of one step",
        "kitchen(a). quantity(a,1). goal(b). goal(c). input((one;two),a). object((a;b;c)). state((a;b;c),s).",
        "do/2",
        (),
        recipes="one: a -> b; two: a -> c",
        constants="semantics=consume",
        parts=(("step", 1), ("check", 1)),
        on="last(1)",
    ),
    Case(
        "planning/plan.lp",
        "the unit for b may be done in any of two steps",
        "kitchen(a). goal(b). goal(d). price((one;two;three),1).",
        "do/2",
        ("do(one,1) do(two,1) do(three,2)", "do(one,2) do(two,1) do(three,2)"),
        recipes="one: a -> b; two: a -> c; three: c -> d",
        parts=(("step", 1), ("step", 2), ("check", 2), ("cheapest", 2)),
        on="last(2)",
    ),
    Case(
        "planning/plan_pruning.lp",
        "pruned, it is done as early as can be",
        "kitchen(a). goal(b). goal(d). price((one;two;three),1).",
        "do/2",
        ("do(one,1) do(two,1) do(three,2)",),
        recipes="one: a -> b; two: a -> c; three: c -> d",
        parts=(("step", 1), ("step", 2), ("check", 2), ("cheapest", 2)),
        on="last(2)",
    ),
    Case(
        "planning/occurrences.lp",
        "one hand has no time for both ways, and batter that is used up twice is made twice",
        COOK + "worker(cook,1). able((beat;bake;fry),cook,1,1). most((beat;bake;fry),2). ",
        "do/2",
        ("", "do(bake,1) do(beat,1)", "do(beat,1)", "do(beat,1) do(beat,2)", "do(beat,1) do(fry,1)"),
        constants="bound=2 semantics=consume",
    ),
    Case(
        "planning/work.lp",
        "batter for both is made twice, though it could be there for both at once",
        COOK + TWICE,
        "do/2",
        ("do(bake,1) do(beat,1) do(beat,2) do(fry,1)",),
        constants="bound=4 semantics=consume",
    ),
    Case(
        "planning/work.lp",
        "there is too much to do for one hand",
        COOK + TWICE,
        "do/2",
        (),
        constants="bound=3 semantics=consume",
    ),
    Case(
        "planning/schedule.lp",
        "batter is made for one cake and then for the other, by one hand",
        COOK + TWICE,
        "do/2 by/3",
        (
            "by(bake,1,cook) by(beat,1,cook) by(beat,2,cook) by(fry,1,cook) "
            "do(bake,1) do(beat,1) do(beat,2) do(fry,1)",
        ),
        constants="bound=4 semantics=consume",
    ),
    Case(
        "planning/schedule.lp",
        "two hands could do the work in 3, but batter is not there twice at once",
        COOK + TWICE.replace("worker(cook,1)", "worker(cook,2)"),
        "do/2",
        (),
        constants="bound=2 semantics=consume",
    ),
    Case(
        "planning/schedule.lp",
        "with one hand both are done at the one station, one after the other",
        COOK + TWICE + "at((bake;fry),stove). station(stove,1).",
        "stands/3",
        ("stands((bake,1),stove,1) stands((fry,1),stove,1)",),
        constants="bound=4 semantics=consume",
    ),
    Case(
        "audit/audit.lp",
        "a unit that does nothing, with what it needs from nowhere",
        "unit(7). object(1). state(1,raw). input(7,1). output(7,1).",
        "warning/2",
        ('warning("does-nothing",(7,)) warning("never-runs",(7,))',),
    ),
    Case(
        "audit/audit.lp",
        "a thing that is empty and full, in itself, and names what nothing is called",
        'object(1..2). label(1,"pot"). state(1,"empty"). content(1,"contains","soup"). label(2,"egg"). '
        'relation(2,"in","egg").',
        "warning/2",
        (
            'warning("empty-but-contains",(1,)) warning("holds-itself",(2,))'
            ' warning("unknown-label",(1,"soup"))',
        ),
    ),
    Case(
        "audit/audit.lp",
        "salt is in a bowl that says it holds onion alone, and onion appears from nowhere",
        ONION + 'object(5). label(5,"salt"). relation(5,"in","bowl"). object(6). label(6,"bowl"). '
        'content(6,"contains",("onion";"salt")). kitchen(1). unit(7). input(7,1). output(7,(5;6)). '
        "unit(8). input(8,(1;5)). output(8,4). unit(9). input(9,3). output(9,4). kitchen(3).",
        "warning/2",
        ('warning("content-appears",(7,6,"salt")) warning("not-in-container",(8,5,"input","bowl"))',),
    ),
    Case(
        "audit/audit.lp",
        "the bowl loses its salt, and no output is or contains any",
        'object(1..2). label(1..2,"bowl"). '
        'content(1,"contains",("onion";"salt")). content(2,"contains","onion"). '
        'object(3..4). label(3,"onion"). label(4,"salt"). kitchen(1). unit(7). input(7,1). output(7,2).',
        "warning/2",
        ('warning("content-vanishes",(7,1,"salt"))',),
    ),
    Case(
        "audit/unlock.lp",
        "the edit that opens the whole circle, the first in the file among equals",
        "",
        "edit/2 opened/1 circle/1",
        ("circle(1) circle(2) edit(1,a) opened(1) opened(2) opened(3)",),
        recipes="1: a -> b; 2: b -> a; 3: b -> goal",
    ),
    Case(
        "audit/unlock.lp",
        "what no unit makes is in no circle; needs that can be had are not edited",
        "kitchen(salt).",
        "edit/2 opened/1 circle/1",
        ("edit(1,dough) opened(1) opened(2)",),
        recipes="1: dough, salt -> bread; 2: bread -> toast; 3: fish, oil -> chips",
    ),
)

CASES = (*READINGS, *RETRIEVAL, *CRITERIA, *OTHERS)
