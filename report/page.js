// A column's heading sorts its table; once more, the other way round.
document.querySelectorAll("table").forEach(function (table) {
    const body = table.tBodies[0];
    const headings = Array.from(table.tHead.rows[0].cells);
    const collator = new Intl.Collator("en", { numeric: true });

    function compare(a, b) {
        const x = parseFloat(a.replace(/,/g, "")), y = parseFloat(b.replace(/,/g, ""));
        if (isNaN(x) || isNaN(y)) return isNaN(x) === isNaN(y) ? collator.compare(a, b) : (isNaN(x) ? 1 : -1);
        return x - y;
    }

    headings.forEach(function (heading, column) {
        const button = document.createElement("button");
        button.type = "button";
        button.append.apply(button, Array.from(heading.childNodes));
        heading.append(button);
        button.addEventListener("click", function () {
            const sign = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
            headings.forEach(function (other) { other.removeAttribute("aria-sort"); });
            heading.setAttribute("aria-sort", sign === 1 ? "ascending" : "descending");
            const rows = Array.from(body.rows);
            rows.sort(function (a, b) {
                return sign * compare(a.cells[column].textContent, b.cells[column].textContent);
            });
            rows.forEach(function (row) { body.append(row); });
        });
    });
});
