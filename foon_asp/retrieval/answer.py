"""What is answered: a task tree, or why there is none, and how far it is proven."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from foon_asp.errors import QueryError
from foon_asp.io.text import write_text
from foon_asp.limits import Limit
from foon_asp.model.node import ObjectNode
from foon_asp.query.objective import Costs, Payments
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.tree import Step, TaskTree
from foon_asp.words import counted

if TYPE_CHECKING:
    from foon_asp.draw.formats import Drawing
    from foon_asp.retrieval.wire import RetrievalJson


@dataclass(frozen=True, slots=True, repr=False)
class Answer:
    """The answer to a question; it is true if it has a tree.

    `query` is the question, its goals as object nodes. `status` is `OPTIMAL` (proven), `FOUND` (by a method
    that does not optimise), `UNREACHABLE` (no tree exists; `reason` says why) or `LIMIT` (`limit` was
    reached; the tree is the best so far, if there is one). `bound` then holds what is proven by each
    criterion of the objective: no tree does better by the first, no tree that is best by the first does
    better by the second, and so on. With `OPTIMAL` it holds this of criteria whose costs had to be rounded so
    much that the tree may not be best within a factor of 1.00001. `own` is what the tree pays by criteria of
    the user's own rules, at each priority. `seconds` is wall time. `recorded` is what an answer was read back
    from.
    """

    query: Query
    status: Status
    tree: TaskTree | None
    bound: dict[str, float]
    own: Payments
    reason: str
    seconds: float
    recorded: RetrievalJson | None = None
    limit: Limit | None = None

    def __bool__(self) -> bool:
        return self.tree is not None

    def __iter__(self) -> Iterator[Step]:
        return iter(() if self.tree is None else self.tree.steps)

    @property
    def trees(self) -> tuple[TaskTree, ...]:
        """The tree, if there is one; answers with several trees have the same."""
        return () if self.tree is None else (self.tree,)

    @property
    def costs(self) -> Costs | None:
        """What the tree costs by each criterion; None without a tree."""
        return None if self.tree is None else self.tree.costs

    @property
    def goals(self) -> tuple[ObjectNode, ...]:
        """The goals, as object nodes."""
        return self.query.nodes

    @property
    def goal(self) -> ObjectNode:
        """The goal, or the first of several."""
        return self.goals[0]

    @property
    def by(self) -> tuple[str, ...]:
        """The criteria that the method went by."""
        return self.query.objective.texts

    @property
    def proven(self) -> bool:
        """Whether nothing better exists: the tree is optimal, or there is none at all."""
        return self.status in (Status.OPTIMAL, Status.UNREACHABLE)

    def to_json(self) -> str:
        """Return the answer as `foon-asp retrieve --format json` writes it."""
        # What is declared of JSON takes a while to load, and most answers are shown as text.
        from foon_asp.io.wire import dumps
        from foon_asp.retrieval.wire import retrieval_json

        return dumps(self.recorded or retrieval_json(self))

    @classmethod
    def from_json(cls, text: str | bytes) -> Answer:
        """Read back what `to_json` wrote; `to_json` of it says the same.

        The tree is in a small world of its own, with all that the steps say; constraints are there by name
        alone, in `recorded`. Raises `QueryError` if the text is something else.
        """
        from foon_asp.retrieval.recorded import read_retrieval, recorded_node, recorded_tree

        value = read_retrieval(text)
        tree = recorded_tree(value)
        goal = recorded_node(value.goal)
        query = Query(goal, by=value.by, method=value.method, founded=value.founded)
        own = {int(priority): paid for priority, paid in value.own.items()}
        bound = dict(value.bound or {})
        return cls(query, Status(value.status), tree, bound, own, value.reason, value.seconds, value)

    def to_foon(self) -> str:
        """Return the task tree as FOON text; raise `QueryError` if there is none."""
        if self.tree is None:
            reason = f"no task tree: {self.reason}" if self.reason else "no task tree in time"
            raise QueryError(f"{self.goal}: {reason}")
        comments = [f"Goal:\t{goal}" for goal in self.goals]
        comments += [f"Method:\t{self.query.method} {','.join(self.by)}".rstrip()]
        if not self.tree.executable:
            comments.append("NOT EXECUTABLE")
        return write_text(self.tree.world.foon, self.tree.functional_units, comments)

    def __repr__(self) -> str:
        goals = "; ".join(map(str, self.goals))
        if self.tree is None:
            return f"<Answer: {goals}, {self.status}: {self.reason or 'no tree in time'}>"
        broken = "" if self.tree.executable else ", NOT EXECUTABLE"
        return f"<Answer: {goals}, {self.status}, {counted(len(self.tree), 'step')}{broken}>"

    def __str__(self) -> str:
        from foon_asp.render.tree import retrieval_text

        return retrieval_text(self).rstrip()

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the tree as a picture; raise `QueryError` if there is none."""
        from foon_asp.draw.views import answer_drawing

        return answer_drawing(self, dark)

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import answer_html

        return answer_html(self)


@dataclass(frozen=True, slots=True, repr=False)
class Answered:
    """What has an answer and says more of it; it is true if there is a tree, and has its steps."""

    answer: Answer

    def __bool__(self) -> bool:
        return bool(self.answer)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.answer)

    @property
    def status(self) -> Status:
        """How the search for the tree ended."""
        return self.answer.status

    def to_foon(self) -> str:
        """Return the tree as FOON text; raise `QueryError` if there is none."""
        return self.answer.to_foon()
