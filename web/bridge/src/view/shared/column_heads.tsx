/** The head of a table; a column without a title has names of rows. */
export function ColumnHeads({ titles }: { titles: string[] }) {
  return (
    <thead>
      <tr>
        {titles.map((title, index) =>
          title === '' ? (
            <td key={index} />
          ) : (
            <th key={index} scope="col">
              {title}
            </th>
          ),
        )}
      </tr>
    </thead>
  );
}
