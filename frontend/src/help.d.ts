/** Made by `helpPages.ts` when the page is built. */
declare module "*.md" {
  const page: import("./logic/page/help").HelpPage;
  export default page;
}
