// Wide tables scroll; keys do it too. The empty corner of a table is no heading. In a cell a number and its % stay together.
// Tables of texts have no room on a phone: there each row is a card, whose cells know their headings (site.css). Where a line
// of code breaks, it does so between words, not behind the dashes of --max.
addEventListener("load", () => {
  for (const table of document.querySelectorAll(".md-typeset table")) {
    const [heads, ...rows] = [...table.rows].map((row) => [...row.cells]);
    if (heads.length < 3 || !rows.some((row) => row.some((cell) => cell.textContent.length > 60))) continue;
    table.dataset.cards = "";
    for (const row of rows) row.forEach((cell, i) => { if (i) cell.dataset.head = heads[i].textContent; });
  }
  for (const code of document.querySelectorAll(".md-typeset pre > code")) {
    const texts = document.createTreeWalker(code, NodeFilter.SHOW_TEXT), all = [];
    while (texts.nextNode()) all.push(texts.currentNode);
    for (const text of all)
      text.replaceWith(...text.data.split(/(\S*-\S*)/).map((piece, i) => {
        if (i % 2 === 0 || piece.length > 30) return piece;
        const word = document.createElement("span");
        word.className = "whole";
        word.textContent = piece;
        return word;
      }));
  }
  for (const table of document.querySelectorAll(".md-typeset__scrollwrap")) table.tabIndex = 0;
  for (const head of document.querySelectorAll("th:empty")) head.replaceWith(document.createElement("td"));
  for (const cell of document.querySelectorAll("td")) {
    const texts = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) texts.currentNode.data = texts.currentNode.data.replaceAll(" %", "\u00a0%");
  }
});
