/** The sample that the tour goes through, told by its files: its project may have any name. */
export function isSample(files: readonly { path: string }[]): boolean {
  const paths = files.map(({ path }) => path);
  return paths.includes("Main.st") && paths.includes("Belt.st");
}
